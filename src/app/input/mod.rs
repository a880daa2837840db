//! What comes from the terminal: bytes in, keys and answers out.
//!
//! Our own reading, because crossterm's knows the answers to its own questions only: it takes the colour of
//! an OSC answer for keys, and the first piece of a split arrow for Esc. A parser of what goes *to* a
//! terminal (`vte`) doesn't fit either: there `ESC` and a space begin a sequence, here they are Alt and a
//! key; it doesn't tell when an APC or an unknown CSI ends, which is where a key may begin; and it keeps an
//! OSC of any length.

mod answers;
#[cfg(unix)]
mod decoder;
#[cfg(unix)]
mod key_codes;
#[cfg(unix)]
mod reader;
#[cfg(not(unix))]
mod reader {
    //! Keys where there is no Unix terminal to read: crossterm's.
    use std::io;
    use std::thread;

    use ratatui::crossterm::event;

    use super::Input;

    /// Starts to read, and to tell what came.
    pub fn start(mut tell: impl FnMut(Input) + Send + 'static) -> io::Result<()> {
        let read = move || {
            loop {
                let input = match event::read() {
                    Ok(event::Event::Key(key)) if !key.is_release() => Input::Key(key),
                    Ok(event::Event::Resize(..)) => Input::Resized,
                    Ok(_) => continue,
                    Err(error) => Input::Failed(error),
                };
                let last = matches!(input, Input::Failed(_));
                tell(input);
                if last {
                    return;
                }
            }
        };
        thread::Builder::new().name("keys".to_owned()).spawn(read).map(drop)
    }
}
mod mouse;
mod received;

#[cfg(test)]
pub use answers::in_command;
pub use answers::{Answer, Colored};
pub use mouse::Mouse;
#[cfg(unix)]
pub use reader::discard;
pub use reader::start;
pub use received::Input;
