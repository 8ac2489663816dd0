//! One client of a hub: a thread that reads, and one that writes.

use super::board::{Board, Inbox, MOST_WAITING, Seat};
use super::dialect::{Answer, Dialect};
use crate::Received;
use crate::queue::Queue;
use std::io::{self, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// How many frames go into one segment at most.
const MOST_AT_ONCE: usize = 256;

/// What waits for being written.
enum Outgoing {
    Frame(Received),
    Reply(&'static [u8]),
    Pause(Duration),
}

impl Inbox for Queue<Outgoing> {
    fn put(&self, received: Received) -> bool {
        self.push(Outgoing::Frame(received))
    }
}

/// A client and its threads.
pub(super) struct Session {
    stream: TcpStream,
    reader: Option<JoinHandle<()>>,
}

impl Session {
    /// Serves a client. `None` where there are too many already, or it is gone, or the system has no threads left: the
    /// connection is closed then.
    pub(super) fn start(stream: TcpStream, board: &Arc<Board>, dialect: Box<dyn Dialect>) -> Option<Self> {
        let client = Client::admit(&stream, board, dialect).ok()??;
        let reader =
            thread::Builder::new().name("hub client".to_owned()).spawn(move || client.serve()).ok()?;
        Some(Self { stream, reader: Some(reader) })
    }

    pub(super) fn is_over(&self) -> bool {
        self.reader.as_ref().is_none_or(JoinHandle::is_finished)
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        // Ends reading and writing; both fail where the client is gone, which is as good.
        let _ = self.stream.shutdown(Shutdown::Both);
        if let Some(reader) = self.reader.take() {
            // A panic there has nothing to tell here.
            let _ = reader.join();
        }
    }
}

/// What the reading thread knows. Dropping it ends the connection and takes the client off the board.
struct Client {
    stream: TcpStream,
    board: Arc<Board>,
    seat: Seat,
    outbox: Arc<Queue<Outgoing>>,
    dialect: Box<dyn Dialect>,
}

impl Client {
    fn admit(stream: &TcpStream, board: &Arc<Board>, dialect: Box<dyn Dialect>) -> io::Result<Option<Self>> {
        // Frames are small and matter now: no waiting for more of them.
        stream.set_nodelay(true)?;
        let stream = stream.try_clone()?;
        let (board, seat) = (Arc::clone(board), board.seat());
        let is_admitted = board.admit();
        let outbox = Arc::new(Queue::new(MOST_WAITING));
        Ok(is_admitted.then(|| Self { stream, board, seat, outbox, dialect }))
    }

    fn serve(mut self) {
        let (outbox, encode) = (Arc::clone(&self.outbox), self.dialect.encoder());
        let Ok(stream) = self.stream.try_clone() else { return };
        let write = move || {
            // The client is gone or shut out; the reading thread sees the same.
            let _ = write_all(&stream, &outbox, encode);
            let _ = stream.shutdown(Shutdown::Both);
        };
        let Ok(writer) = thread::Builder::new().name("hub client, writing".to_owned()).spawn(write) else {
            return;
        };
        if let Some(greeting) = self.dialect.greeting() {
            self.outbox.push(Outgoing::Reply(greeting));
        }
        // It ends with the connection; why makes no difference.
        let _ = self.read_all();
        drop(self);
        // A panic there has nothing to tell here.
        let _ = writer.join();
    }

    fn read_all(&mut self) -> io::Result<()> {
        let mut bytes = [0; 4096];
        loop {
            let count = match self.stream.read(&mut bytes) {
                Ok(0) => return Ok(()),
                Ok(count) => count,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                Err(error) => return Err(error),
            };
            let Self { board, seat, outbox, dialect, .. } = self;
            let takes_remote_frames = dialect.carries_remote_frames();
            dialect.feed(&bytes[..count], &mut |answer| match answer {
                Answer::Reply(reply) => drop(outbox.push(Outgoing::Reply(reply))),
                Answer::Join(reply, pause) => board.join(*seat, outbox.clone(), takes_remote_frames, || {
                    outbox.push(Outgoing::Reply(reply));
                    outbox.push(Outgoing::Pause(pause));
                }),
                Answer::Leave => board.leave(*seat),
                Answer::Frame(frame) => board.publish(*seat, frame),
            });
        }
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        self.board.leave(self.seat);
        self.outbox.abort();
        // Fails where the client is gone already.
        let _ = self.stream.shutdown(Shutdown::Both);
        self.board.dismiss();
    }
}

/// Writes until the queue is closed or the connection ends. Frames that wait go together, replies by themselves.
fn write_all(
    mut stream: &TcpStream,
    outbox: &Queue<Outgoing>,
    encode: fn(&Received, &mut Vec<u8>),
) -> io::Result<()> {
    let (mut batch, mut bytes) = (Vec::new(), Vec::new());
    loop {
        outbox.take_batch(&mut batch, MOST_AT_ONCE);
        if batch.is_empty() {
            return Ok(());
        }
        for outgoing in batch.drain(..) {
            match outgoing {
                Outgoing::Frame(received) => {
                    encode(&received, &mut bytes);
                    continue;
                }
                Outgoing::Reply(reply) => {
                    flush(stream, &mut bytes)?;
                    stream.write_all(reply)?;
                }
                Outgoing::Pause(time) => {
                    flush(stream, &mut bytes)?;
                    thread::sleep(time);
                }
            }
        }
        flush(stream, &mut bytes)?;
    }
}

fn flush(mut stream: &TcpStream, bytes: &mut Vec<u8>) -> io::Result<()> {
    if !bytes.is_empty() {
        stream.write_all(bytes)?;
        bytes.clear();
    }
    Ok(())
}
