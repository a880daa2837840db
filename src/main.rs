//! The command `ray13`; everything it does is a call in [`ray13::cli`].

fn main() -> std::process::ExitCode {
    ray13::cli::run()
}
