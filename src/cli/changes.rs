//! Waits for changes of files: told by the system where it tells, else looked for from time to time.
//!
//! What the system says is only why to look: whether a file is another than before is asked of the file
//! itself, so that no order of events, and no kind of editor, makes a difference. Folders are watched and not
//! files: an editor writes a file beside the old one and moves it there.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, SyncSender};
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use notify::{RecommendedWatcher, RecursiveMode, Watcher};

/// A file that nobody has changed for so long is taken for whole: editors and exporters write without pauses.
const SETTLED: Duration = Duration::from_millis(30);

/// One that is changed all the time is read after so long, whole or not: it is read again afterwards.
const UNSETTLED: Duration = Duration::from_millis(300);

/// How often is looked where the system does not tell: on file systems of other machines.
const POLL: Duration = Duration::from_millis(500);

/// Links that lead to links, at most: more are a circle, as for the system.
const MOST_LINKS: u32 = 40;

/// What is different of a file that is another; absent of one that is not there.
type Mark = Option<(u64, u64, u64, [i64; 4])>;

/// Waits for changes of some files.
pub struct Changes {
    files: BTreeMap<PathBuf, Mark>,
    /// The folders that are watched, with what they were then.
    folders: BTreeMap<PathBuf, (u64, u64)>,
    watcher: Option<RecommendedWatcher>,
    woken: Receiver<()>,
    wake: SyncSender<()>,
    is_over: Arc<AtomicBool>,
    /// Whether the system does not tell of all of them.
    is_polled: bool,
}

/// Ends the waiting of another thread.
#[derive(Clone, Debug)]
pub struct EndOfChanges {
    wake: SyncSender<()>,
    is_over: Arc<AtomicBool>,
}

impl EndOfChanges {
    /// From now on nothing is waited for.
    pub fn end(&self) {
        self.is_over.store(true, Ordering::SeqCst);
        let _ = self.wake.try_send(());
    }
}

impl Changes {
    /// Of no file so far.
    pub fn new() -> Self {
        // One word is enough to look at everything.
        let (wake, woken) = mpsc::sync_channel(1);
        let is_over = Arc::default();
        let (files, folders) = (BTreeMap::new(), BTreeMap::new());
        Self { files, folders, watcher: None, woken, wake, is_over, is_polled: false }
    }

    /// What ends the waiting.
    pub fn end(&self) -> EndOfChanges {
        EndOfChanges { wake: self.wake.clone(), is_over: Arc::clone(&self.is_over) }
    }

    /// These files as they are now: what is done with them after this sees any change before it.
    pub fn note(&mut self, files: impl IntoIterator<Item = PathBuf>) {
        self.files = files.into_iter().map(|file| (file.clone(), mark(&file))).collect();
        self.follow();
    }

    /// Adds files that were read since a time. What has changed since then was read before or after, which
    /// nobody knows: it counts as changed.
    pub fn add(&mut self, files: impl IntoIterator<Item = PathBuf>, since: SystemTime) {
        for file in files {
            if self.files.contains_key(&file) {
                continue;
            }
            let is_new = fs::metadata(&file).and_then(|found| found.modified()).is_ok_and(|at| at >= since);
            let known = if is_new { Some((0, 0, 0, [0; 4])) } else { mark(&file) };
            self.files.insert(file, known);
        }
        self.follow();
    }

    /// Waits for a change of any of them, and until there is no other for a moment; `false` at the end.
    pub fn wait(&mut self) -> bool {
        loop {
            self.follow();
            if self.is_over.load(Ordering::SeqCst) {
                return false;
            }
            if self.files.iter().any(|(file, known)| mark(file) != *known) {
                return self.settle();
            }
            if self.is_polled {
                match self.woken.recv_timeout(POLL) {
                    Ok(()) | Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => return false,
                }
            } else if self.woken.recv().is_err() {
                return false;
            }
        }
    }

    fn settle(&mut self) -> bool {
        let begin = Instant::now();
        let marks = |files: &BTreeMap<PathBuf, Mark>| files.keys().map(|file| mark(file)).collect::<Vec<_>>();
        let mut now = marks(&self.files);
        while begin.elapsed() < UNSETTLED {
            thread::sleep(SETTLED);
            let next = marks(&self.files);
            if next == now {
                break;
            }
            now = next;
        }
        !self.is_over.load(Ordering::SeqCst)
    }

    /// Watches the folders in which the files are now, and no others.
    fn follow(&mut self) {
        if self.watcher.is_none() && !self.files.is_empty() {
            let wake = self.wake.clone();
            let tell = move |event: notify::Result<notify::Event>| {
                // That a file is read is no change of it.
                if !event.is_ok_and(|event| event.kind.is_access()) {
                    let _ = wake.try_send(());
                }
            };
            self.watcher = notify::recommended_watcher(tell).ok();
        }
        let mut folders = BTreeSet::new();
        for file in self.files.keys() {
            folders_of(file, &mut folders, MOST_LINKS);
        }
        let folders: BTreeMap<PathBuf, (u64, u64)> =
            folders.into_iter().map(|folder| (folder.clone(), identity(&folder))).collect();
        if folders == self.folders {
            return;
        }
        self.is_polled = self.watcher.is_none();
        let Some(watcher) = &mut self.watcher else { return };
        for gone in self.folders.iter().filter(|(folder, is)| folders.get(*folder) != Some(is)) {
            // Of a folder that is no more there is nothing to tell.
            let _ = watcher.unwatch(gone.0);
        }
        for (folder, is) in &folders {
            let is_watched = self.folders.get(folder) == Some(is)
                || watcher.watch(folder, RecursiveMode::NonRecursive).is_ok();
            self.is_polled |= !is_watched || is_remote(folder);
        }
        self.folders = folders;
    }
}

/// What a file is now.
#[cfg(unix)]
fn mark(file: &Path) -> Mark {
    use std::os::unix::fs::MetadataExt;
    let found = fs::metadata(file).ok()?;
    let times = [found.mtime(), found.mtime_nsec(), found.ctime(), found.ctime_nsec()];
    Some((found.dev(), found.ino(), found.len(), times))
}

#[cfg(not(unix))]
fn mark(file: &Path) -> Mark {
    let found = fs::metadata(file).ok()?;
    let since = found.modified().ok()?.duration_since(SystemTime::UNIX_EPOCH).ok()?;
    Some((0, 0, found.len(), [since.as_secs() as i64, i64::from(since.subsec_nanos()), 0, 0]))
}

fn identity(folder: &Path) -> (u64, u64) {
    mark(folder).map_or((0, 0), |(device, number, ..)| (device, number))
}

/// The folders whose entries decide what a path stands for: its own, and those of all links on the way.
fn folders_of(path: &Path, folders: &mut BTreeSet<PathBuf>, links: u32) {
    let Ok(path) = std::path::absolute(path) else { return };
    let mut at = PathBuf::new();
    let parts: Vec<Component<'_>> = path.components().collect();
    for (index, part) in parts.iter().enumerate() {
        let folder = at.clone();
        at.push(part);
        if let (Ok(target), 1..) = (fs::read_link(&at), links) {
            let rest: PathBuf = parts[index + 1..].iter().collect();
            folders.insert(folder.clone());
            let target = folder.join(target);
            let whole = if rest.as_os_str().is_empty() { target } else { target.join(rest) };
            folders_of(&whole, folders, links - 1);
            return;
        }
        // Where there is no such folder, the one is watched in which it may come to be.
        if !at.exists() || index + 1 == parts.len() {
            folders.insert(folder);
            return;
        }
    }
}

/// Whether a folder is on a file system that another machine, or another program, may change without a word:
/// NFS, SMB, FUSE, 9P, AFS, Coda, Ceph, and the shared folders of `VirtualBox`, by the numbers of Linux's
/// `statfs`.
#[cfg(target_os = "linux")]
fn is_remote(folder: &Path) -> bool {
    const REMOTE: [u32; 10] = [
        0x6969,
        0x517b,
        0xfe53_4d42,
        0xff53_4d42,
        0x6573_5546,
        0x0102_1997,
        0x5346_414f,
        0x7375_7245,
        0x00c3_6400,
        0x786f_4256,
    ];
    rustix::fs::statfs(folder).is_ok_and(|found| REMOTE.contains(&(found.f_type as u32)))
}

#[cfg(not(target_os = "linux"))]
fn is_remote(_: &Path) -> bool {
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(unix)]
    fn links_are_watched_where_they_are_and_where_they_lead() {
        let home = tempfile::tempdir().unwrap();
        let home = fs::canonicalize(home.path()).unwrap();
        let path = |name: &str| home.join(name);
        for folder in ["a", "b"] {
            fs::create_dir_all(path(folder)).unwrap();
        }
        std::os::unix::fs::symlink("../b/file", path("a/link")).unwrap();
        std::os::unix::fs::symlink("a", path("way")).unwrap();
        std::os::unix::fs::symlink("circle", path("circle")).unwrap();
        let folders = |file: &str| {
            let mut folders = BTreeSet::new();
            folders_of(&path(file), &mut folders, MOST_LINKS);
            folders
                .into_iter()
                .map(|f| f.strip_prefix(&home).map(Path::to_owned).unwrap_or(f))
                .collect::<Vec<_>>()
        };
        assert_eq!(folders("a/file"), [Path::new("a")]);
        assert_eq!(folders("none/deep/file"), [Path::new("")]);
        let through = folders("way/link");
        assert!(["", "a"].iter().all(|folder| through.contains(&PathBuf::from(folder))), "{through:?}");
        assert!(through.iter().any(|folder| folder.ends_with("b")), "{through:?}");
        assert_eq!(folders("circle"), [Path::new("")]);
    }

    #[test]
    fn each_way_to_change_a_file_is_one() {
        let home = tempfile::tempdir().unwrap();
        let file = home.path().join("part.scad");
        fs::write(&file, "a").unwrap();
        let ways: [fn(&Path); 4] = [
            |file| fs::write(file, "bb").unwrap(),
            |file| {
                fs::write(file.with_extension("new"), "cc").unwrap();
                fs::rename(file.with_extension("new"), file).unwrap();
            },
            |file| fs::remove_file(file).unwrap(),
            |file| fs::write(file, "cc").unwrap(),
        ];
        let mut changes = Changes::new();
        for way in ways {
            changes.note([file.clone()]);
            let path = file.clone();
            let change = thread::spawn(move || way(&path));
            assert!(changes.wait());
            change.join().unwrap();
        }
        changes.note([file.clone()]);
        changes.end().end();
        assert!(!changes.wait(), "nothing has changed, and it is over");
    }
}
