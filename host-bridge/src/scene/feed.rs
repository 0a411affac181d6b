//! Scene changes from other programs: lines of JSON over TCP on loopback, each answered with one.

use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::mpsc::{Receiver, Sender, SyncSender, channel, sync_channel};
use std::time::Duration;

use super::line::LONGEST;

/// How many lines may wait to be taken over before those who send them have to wait.
const WAITING: usize = 64;

/// How long an answer may take.
const PATIENCE: Duration = Duration::from_secs(5);

/// A line that somebody sent.
#[derive(Debug)]
pub struct Request {
    /// The line, without its end.
    pub line: Vec<u8>,
    answer: Sender<String>,
}

impl Request {
    /// Answers it with one line.
    pub fn answer(&self, line: String) {
        // Whoever has hung up does not want to know.
        let _ = self.answer.send(line);
    }
}

/// Listens for lines.
#[derive(Debug)]
pub struct Feed {
    requests: Receiver<Request>,
    address: SocketAddr,
}

impl Feed {
    /// Listens on a port of loopback; 0 takes a free one.
    ///
    /// # Errors
    /// When the port cannot be had.
    pub fn listen(port: u16) -> io::Result<Self> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port))?;
        let address = listener.local_addr()?;
        let (to, requests) = sync_channel(WAITING);
        std::thread::spawn(move || {
            for stream in listener.incoming().flatten() {
                let to = to.clone();
                std::thread::spawn(move || serve(&stream, &to));
            }
        });
        Ok(Self { requests, address })
    }

    /// Where it listens.
    #[must_use]
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// The next line, if there is one.
    #[must_use]
    pub fn next(&self) -> Option<Request> {
        self.requests.try_recv().ok()
    }
}

/// Takes lines from one connection until it ends.
fn serve(stream: &TcpStream, to: &SyncSender<Request>) -> Option<()> {
    let mut input = BufReader::new(stream);
    loop {
        let mut line = Vec::new();
        let most = LONGEST as u64 + 2;
        if input
            .by_ref()
            .take(most)
            .read_until(b'\n', &mut line)
            .ok()?
            == 0
        {
            return None;
        }
        if line.last() != Some(&b'\n') && line.len() > LONGEST {
            input.skip_until(b'\n').ok()?;
        }
        let line = line.trim_ascii_end().to_vec();
        let (answer, answers) = channel();
        to.send(Request { line, answer }).ok()?;
        let mut answer = answers.recv_timeout(PATIENCE).ok()?;
        answer.push('\n');
        (&mut &*stream).write_all(answer.as_bytes()).ok()?;
    }
}

/// Sends a line to a session's feed and gives its answer.
///
/// # Errors
/// When nobody listens there, or hangs up.
pub fn ask(port: u16, line: &str) -> io::Result<String> {
    let mut stream = TcpStream::connect((Ipv4Addr::LOCALHOST, port))?;
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.write_all(format!("{line}\n").as_bytes())?;
    let mut answer = String::new();
    match BufReader::new(stream).read_line(&mut answer)? {
        0 => Err(io::ErrorKind::UnexpectedEof.into()),
        _ => Ok(answer),
    }
}
