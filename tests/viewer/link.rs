//! The viewer at the other end of a thin link: a real sshd behind a bucket of 80 kbit/s, and behind mosh and
//! tmux.
//!
//! sshd and TCP take in whatever is written: 30 pictures a second for ten seconds were shown for 55 s more,
//! up to 56 s old.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};
use std::{env, fs};

use super::pty::Pty;
use crate::{BEGIN_UPDATE, Reading, SCENE, SMALLEST, VIEWER};

/// Degrees of a turn per press of the arrow.
const STEP: f64 = 5.0;

/// Between two presses of a key that is held down.
const REPEAT: Duration = Duration::from_millis(33);

/// Two network namespaces, the server's and that of this script, joined by a pair of interfaces that let
/// through 80 kbit/s each; their queues hold a minute, as those of modems and phones do. sshd wants a folder
/// of its own in /run.
const THIN: &str = r#"
    set -e
    folder=$1 program=$2 scene=$3
    mount -t tmpfs none /run && mkdir /run/sshd
    ip link set lo up
    unshare -n sleep 300 & server=$!
    trap 'kill $server' EXIT
    until [ "$(readlink /proc/$server/ns/net)" != "$(readlink /proc/self/ns/net)" ]; do sleep 0.01; done
    ip link add here type veth peer name there
    ip link set there netns $server
    ip addr add 10.13.0.1/24 dev here && ip link set here up
    tc qdisc add dev here root tbf rate 80kbit burst 2kb latency 60s
    nsenter -t $server -n sh -ec '
        ip link set lo up && ip addr add 10.13.0.2/24 dev there && ip link set there up
        tc qdisc add dev there root tbf rate 80kbit burst 2kb latency 60s'
    nsenter -t $server -n "$(command -v sshd)" -D -f "$folder/sshd_config" & sshd=$!
    trap 'kill $sshd $server' EXIT
    ssh -F none -i "$folder/key" -o StrictHostKeyChecking=no -o UserKnownHostsFile=/dev/null -o LogLevel=ERROR \
        -o ConnectionAttempts=20 -p 2213 -tt root@10.13.0.2 "LC_ALL=C.UTF-8 $program $scene"
"#;

/// Why there is no thin link here; absent where there is one.
fn no_thin_link() -> Option<&'static str> {
    let works = |command: &str| {
        let status = Command::new("sh").args(["-c", command]).env("PATH", path()).output();
        status.is_ok_and(|output| output.status.success())
    };
    let needs = [
        ("test $(id -u) = 0", "only root may make network namespaces and run sshd"),
        ("command -v sshd && command -v ssh && command -v ssh-keygen", "no sshd or ssh is installed"),
        ("command -v ip && command -v tc && command -v nsenter", "ip, tc or nsenter is not installed"),
        ("unshare -nm mount -t tmpfs none /run", "namespaces are not allowed here"),
        (
            "unshare -n sh -ec 'ip link add here type veth peer name there; tc qdisc add dev here \
             root tbf rate 80kbit burst 2kb latency 60s'",
            "this kernel has no veth or tbf",
        ),
    ];
    needs.into_iter().find(|(command, _)| !works(command)).map(|(_, why)| why)
}

/// Where sshd, ip and tc are, too.
fn path() -> String {
    env::var("PATH").unwrap_or_default() + ":/usr/sbin:/sbin"
}

/// A folder with the keys and the settings of an sshd.
fn sshd_folder() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("sshd");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let key = folder.join("key");
    let made = Command::new("ssh-keygen").args(["-q", "-t", "ed25519", "-N", "", "-f"]).arg(&key).status();
    assert!(made.unwrap().success());
    let place = folder.display();
    let settings = format!(
        "Port 2213\nListenAddress 10.13.0.2\nHostKey {place}/key\nAuthorizedKeysFile {place}/key.pub\n\
         StrictModes no\nUsePAM no\nPermitRootLogin yes\nPidFile none\nPrintMotd no\nPrintLastLog no\n"
    );
    fs::write(folder.join("sshd_config"), settings).unwrap();
    folder
}

/// How many presses of the right arrow the screen shows, counted on from what it has shown: a turn is 72.
fn presses_shown(pty: &Pty, first: f64, before: usize) -> Option<usize> {
    let status = pty.row(pty.size().rows - 3);
    let azimuth: f64 = status.split("DIR ").nth(1)?.split(' ').next()?.parse().ok()?;
    let steps = (azimuth - first) / STEP;
    let further = (steps - before as f64).rem_euclid(72.0);
    // A step that is a rounding short of none is none.
    Some(before + further.round() as usize % 72)
}

/// What was seen while an arrow was held down.
struct Held {
    /// How old what was shown was at most: how long ago the key came that it does not have yet.
    oldest: Duration,
    /// How long after the last key the screen stood still with all of them.
    still: Duration,
    /// How many different pictures were shown.
    pictures: usize,
}

/// Holds the right arrow down for a time, and waits until all of it is shown.
fn hold_an_arrow(pty: &mut Pty, time: Duration) -> Held {
    let azimuth = |pty: &Pty| presses_shown(pty, 0.0, 0).map(|steps| steps as f64 * STEP);
    let first = azimuth(pty).expect("the status line");
    let begin = Instant::now();
    let mut sent = Vec::new();
    let (mut shown, mut oldest, mut pictures) = (0, Duration::ZERO, 0);
    loop {
        let due = begin + REPEAT * u32::try_from(sent.len()).unwrap();
        let all_sent = begin.elapsed() >= time;
        if all_sent && shown == sent.len() {
            break;
        }
        if !all_sent && Instant::now() >= due {
            pty.send("\x1b[C");
            sent.push(Instant::now());
            continue;
        }
        let until = if all_sent { Instant::now() + Duration::from_secs(60) } else { due };
        assert!(pty.take_output(until), "the viewer ended");
        let now = presses_shown(pty, first, shown).unwrap_or(shown);
        if now != shown {
            // Until now it has shown the state before this key.
            oldest = oldest.max(sent[shown].elapsed());
            (shown, pictures) = (now, pictures + 1);
        }
        assert!(begin.elapsed() < time + Duration::from_secs(90), "{shown} of {} keys are shown", sent.len());
    }
    Held { oldest, still: sent.last().unwrap().elapsed(), pictures }
}

/// The issue of a thin link: a minute of pictures stood in its queues, and `q` behind them.
#[test]
fn over_a_thin_link_nothing_shown_is_old_and_the_end_is_near() {
    if let Some(why) = no_thin_link() {
        eprintln!("skipped: {why}");
        return;
    }
    let folder = sshd_folder();
    let path = format!("PATH={}", path());
    let folder = folder.to_str().unwrap();
    let command = ["env", &path, "unshare", "-nm", "sh", "-c", THIN, "sh", folder, VIEWER, SCENE];
    let mut pty = Pty::start(&command, SMALLEST);
    pty.wait_for("the first picture", Reading::drawn);

    let long = env::var_os("RAY13_LONG").is_some();
    let held = hold_an_arrow(&mut pty, Duration::from_secs(if long { 10 } else { 3 }));
    eprintln!("{} pictures, still after {:?}, at most {:?} old", held.pictures, held.still, held.oldest);
    assert!(held.still < Duration::from_secs(1), "still {:?} after the last key", held.still);
    assert!(held.oldest < Duration::from_millis(1_500), "{:?} old", held.oldest);
    assert!(held.pictures >= 4, "{} pictures in four seconds", held.pictures);

    for _ in 0..30 {
        pty.send("\x1b[C");
        let next = Instant::now() + REPEAT;
        while Instant::now() < next && pty.take_output(next) {}
    }
    pty.send("q");
    let typed = Instant::now();
    pty.wait_for("the screen of before", |pty| {
        pty.log().ends_with(b"\x1b[?1049l\x1b[?25h") || pty.given_back()
    });
    eprintln!("given back {:?} after q", typed.elapsed());
    assert!(typed.elapsed() < Duration::from_secs(1), "{:?} after q", typed.elapsed());
    pty.wait_for_end(0);
}

/// The ceiling that an option sets holds from the first picture on.
#[test]
fn no_more_bytes_a_second_are_sent_than_asked_for() {
    const CEILING: usize = 8_000;
    let mut pty = Pty::start(&[VIEWER, SCENE, "--aa", "off", "--bytes-per-second", "8000"], SMALLEST);
    pty.wait_for("the first picture", Reading::drawn);
    let (before, begin) = (pty.log().len(), Instant::now());
    let held = hold_an_arrow(&mut pty, Duration::from_secs(1));
    let (bytes, seconds) = (pty.log().len() - before, begin.elapsed().as_secs_f64());
    eprintln!("{bytes} bytes, {} pictures in {seconds:.2} s", held.pictures);
    // The last picture is paid for when it is shown already; none is larger than a first one.
    assert!(bytes as f64 <= CEILING as f64 * seconds + 6_000.0, "{bytes} bytes in {seconds:.2} s");
    assert!(held.pictures >= 2, "{} pictures", held.pictures);
    pty.send("q");
    pty.wait_for_end(0);
}

/// Counts the pictures that the viewer sends through a relay while an arrow is held down, and that it ends.
fn pictures_a_second_through(relay: &str, needs: &str) -> Option<f64> {
    let found = Command::new("sh")
        .args(["-c", &format!("command -v script && command -v {needs}")])
        .output()
        .unwrap();
    if !found.status.success() {
        eprintln!("skipped: script or {needs} is not installed");
        return None;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(needs);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    // What the viewer writes, before the relay makes fewer pictures of it.
    let written = folder.join("written");
    let viewer = format!("script -qfec '{VIEWER} {SCENE}' {}", written.display());
    let folder = folder.to_str().unwrap();
    let mut pty = Pty::start(&["env", "LC_ALL=C.UTF-8", "sh", "-c", relay, "sh", folder, &viewer], SMALLEST);
    pty.wait_for("the first picture", Reading::drawn);
    let count = || {
        let bytes = fs::read(&written).unwrap();
        bytes.windows(BEGIN_UPDATE.len()).filter(|window| *window == BEGIN_UPDATE.as_bytes()).count()
    };
    let (before, begin) = (count(), Instant::now());
    hold_an_arrow(&mut pty, Duration::from_secs(2));
    let (pictures, seconds) = (count() - before, begin.elapsed().as_secs_f64());
    pty.send("q");
    pty.wait_for("the end", |pty| pty.text().contains("code=0 modes=same left=[]"));
    eprintln!("{pictures} pictures in {seconds:.2} s through {needs}");
    // One more than the intervals between them.
    Some((pictures as f64 - 1.0) / seconds)
}

/// tmux answers for itself, at once, so the number of pictures is held down by the clock.
#[test]
fn through_tmux_there_are_at_most_twenty_pictures_a_second() {
    let relay = r#"exec tmux -f /dev/null -S "$1/socket" new-session "$2" \; set -g status off"#;
    if let Some(rate) = pictures_a_second_through(relay, "tmux") {
        assert!((2.0..=20.5).contains(&rate), "{rate} pictures a second");
    }
}

#[test]
fn through_mosh_there_are_at_most_twenty_pictures_a_second() {
    let relay = r#"
        server=$(mosh-server new -i 127.0.0.1 -- sh -c "$2" 2>/dev/null </dev/null)
        set -- $(echo "$server" | grep '^MOSH CONNECT')
        MOSH_KEY=$4 exec mosh-client 127.0.0.1 "$3""#;
    if let Some(rate) = pictures_a_second_through(relay, "mosh-client") {
        assert!((2.0..=20.5).contains(&rate), "{rate} pictures a second");
    }
}
