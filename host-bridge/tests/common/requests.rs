//! Requests to an arm's or a hand's control and answers to them, as they lie on a stream.

use std::io::{Read, Write};
use std::net::TcpStream;

use franka::wire::HeaderLayout;

/// The next request: its command, its number, what it carries.
pub fn receive(stream: &mut TcpStream, layout: HeaderLayout) -> Option<(u32, u32, Vec<u8>)> {
    let mut header = vec![0; layout.header_len()];
    stream.read_exact(&mut header).ok()?;
    let (command, id, size) = layout.decode_header(&header)?;
    let mut payload = vec![0; size as usize - layout.header_len()];
    stream.read_exact(&mut payload).ok()?;
    Some((command, id, payload))
}

/// Answers a request.
pub fn respond(
    stream: &mut TcpStream,
    layout: HeaderLayout,
    command: u32,
    id: u32,
    payload: &[u8],
) {
    let mut message = layout.encode_header(command, id, payload.len());
    message.extend_from_slice(payload);
    let _ = stream.write_all(&message);
}
