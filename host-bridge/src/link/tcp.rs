//! A unit behind a TCP stream.

use std::io::{self, ErrorKind, Read, Write};
use std::net::{TcpStream, ToSocketAddrs};
use std::time::Duration;

use super::{Wire, WireError};

/// How long a host may take to answer.
const PATIENCE: Duration = Duration::from_secs(3);

/// What is not worth waiting for.
const SHORTEST: Duration = Duration::from_millis(1);

/// An open stream.
pub struct Stream(TcpStream);

impl Stream {
    /// Connects.
    pub fn open(host: &str, port: u16) -> Result<Self, WireError> {
        let connect = || {
            let mut last = io::Error::new(ErrorKind::NotFound, "the name has no address");
            for address in (host.trim_matches(['[', ']']), port).to_socket_addrs()? {
                match TcpStream::connect_timeout(&address, PATIENCE) {
                    Ok(stream) => return Ok(stream),
                    Err(error) => last = error,
                }
            }
            Err(last)
        };
        let stream = connect().and_then(Self::over);
        stream.map_err(|cause| WireError::Tcp {
            address: format!("{host}:{port}"),
            cause,
        })
    }

    /// A stream that is already there.
    pub fn over(stream: TcpStream) -> io::Result<Self> {
        stream.set_nonblocking(false)?;
        // A frame is small and waited for: without this it would sit in the sender for 40 ms.
        stream.set_nodelay(true)?;
        stream.set_write_timeout(Some(PATIENCE))?;
        Ok(Self(stream))
    }
}

impl Wire for Stream {
    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.0.write_all(bytes)
    }

    fn read(&mut self, buffer: &mut [u8], patience: Duration) -> io::Result<usize> {
        // The system rounds timeouts up to whole ticks of 4 ms or more, and takes 0 for none at all.
        let at_once = patience < SHORTEST;
        self.0.set_nonblocking(at_once)?;
        if !at_once {
            self.0.set_read_timeout(Some(patience))?;
        }
        let read = self.0.read(buffer);
        if at_once {
            self.0.set_nonblocking(false)?;
        }
        match read {
            Ok(0) => Err(ErrorKind::UnexpectedEof.into()),
            // A signal, as Ctrl-C sends one, interrupts the waiting only.
            Err(e)
                if matches!(
                    e.kind(),
                    ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted
                ) =>
            {
                Ok(0)
            }
            other => other,
        }
    }
}
