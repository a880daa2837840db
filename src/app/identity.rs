//! Which program draws our screen, as far as it matters: whether it answers for a terminal that is somewhere
//! else.

use std::env;

use super::input::Answer;

/// Asks for secondary device attributes. Terminals that know the question answer it, others say nothing.
pub const QUESTION: &[u8] = b"\x1b[>c";

/// What stands between us and the terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Identity {
    /// A terminal: its answers come from where the picture is seen.
    Terminal,
    /// mosh, tmux or screen: they answer at once, whatever way the picture has still to go, and show it at a
    /// rate of their own.
    Relay,
}

/// Whether a terminal of this name (`TERM`) may be asked: the Linux console answers a status request only,
/// and what is called dumb could print the question.
pub fn may_be_asked(name: &str) -> bool {
    !matches!(name, "" | "dumb" | "linux")
}

impl Identity {
    /// Who has answered; where nobody said who they are, what the environment says.
    pub fn of(answers: &[Answer], name: &str) -> Self {
        let told = answers.iter().find_map(|&answer| Self::told(answer));
        told.unwrap_or_else(|| Self::from_environment(name, |variable| env::var_os(variable).is_some()))
    }

    /// Who tells so by an answer. mosh says to be a VT220 of version 10, which no other does; tmux is `T`,
    /// screen `S`.
    pub fn told(answer: Answer) -> Option<Self> {
        match answer {
            Answer::Identity { kind: 1, version: 10 } | Answer::Identity { kind: 83 | 84, .. } => {
                Some(Self::Relay)
            }
            Answer::Identity { .. } => Some(Self::Terminal),
            Answer::Status | Answer::Color { .. } => None,
        }
    }

    /// tmux and screen set variables and a name of their own; `sudo` and `ssh` may lose the variables.
    fn from_environment(name: &str, is_set: impl Fn(&str) -> bool) -> Self {
        let named = ["tmux", "screen"].iter().any(|relay| name.starts_with(relay));
        if named || ["TMUX", "STY"].into_iter().any(is_set) { Self::Relay } else { Self::Terminal }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn relays_are_known_by_their_answers() {
        let told = |kind, version| Identity::told(Answer::Identity { kind, version });
        for (kind, version) in [(1, 10), (84, 0), (83, 40_900)] {
            assert_eq!(told(kind, version), Some(Identity::Relay));
        }
        // xterm, VTE, PuTTY, alacritty, kitty, macOS.
        for (kind, version) in [(41, 388), (65, 7600), (0, 136), (0, 2_401), (1, 4_000), (1, 95)] {
            assert_eq!(told(kind, version), Some(Identity::Terminal));
        }
        assert_eq!(Identity::told(Answer::Status), None);
    }

    #[test]
    fn without_an_answer_the_environment_counts() {
        let nothing = |_: &str| false;
        assert_eq!(Identity::from_environment("xterm-256color", nothing), Identity::Terminal);
        assert_eq!(Identity::from_environment("tmux-256color", nothing), Identity::Relay);
        assert_eq!(Identity::from_environment("screen", nothing), Identity::Relay);
        assert_eq!(Identity::from_environment("xterm", |variable| variable == "STY"), Identity::Relay);
        let told = [Answer::Identity { kind: 41, version: 388 }];
        assert_eq!(Identity::of(&told, "screen"), Identity::Terminal, "an answer counts for more");
    }

    #[test]
    fn some_are_not_asked() {
        assert!(may_be_asked("xterm-256color"));
        assert!(["linux", "dumb", ""].iter().all(|name| !may_be_asked(name)));
    }
}
