//! The shortest of all ways to write what has to be written.
//!
//! The same cell can be written in several spellings, with several pens, and what stands between two changes
//! can be passed or written again. Which is shortest depends on what follows: a colour that costs more now
//! may save the next change. So all ways are kept side by side, as a shortest path through pens by dynamic
//! programming: after each step, for each pen that the terminal may have then, the cheapest way to get there.
//! The steps of all ways are a tree, read backwards from the best at the end.

use super::cursor::Hop;
use super::screen::{Spelling, Symbol};
use super::sgr::Pen;

/// Ways that are kept. Those after one spelling of a cell, with what is free taken from the pen before or
/// from one that comes, are fewer nearly always; more would cost time that no frame is worth.
const MOST: usize = 16;

/// A way so far.
#[derive(Clone, Copy, Debug)]
struct Way {
    /// What the terminal writes with at its end.
    pen: Pen,
    /// Its bytes.
    bytes: u32,
    /// Its last step.
    step: usize,
}

/// What is done last on a way.
#[derive(Clone, Copy, Debug)]
enum Step<'a> {
    Go(Hop),
    Put(Pen, Symbol<'a>),
    Erase(Pen),
    Pen(Pen),
}

/// No step: the beginning.
const NONE: usize = usize::MAX;

/// Ways to write something, all to the same end.
#[derive(Debug)]
pub struct Route<'a> {
    begin: Pen,
    ways: Vec<Way>,
    /// Every step with the one before it.
    steps: Vec<(Step<'a>, usize)>,
}

/// The ends of ways, put aside while another continuation is tried.
pub struct WaysAside(Vec<Way>);

impl<'a> Route<'a> {
    /// What [`Route::erase`] takes beside the pen.
    pub const ERASE_BYTES: u32 = ERASE.len() as u32;

    /// Begins where the terminal writes with that pen.
    pub fn new(pen: Pen) -> Self {
        Self { begin: pen, ways: vec![Way { pen, bytes: 0, step: NONE }], steps: Vec::new() }
    }

    /// Moves the cursor.
    pub fn go(&mut self, hop: Hop) {
        if hop != Hop::Stay {
            self.extend(|way| Way { bytes: way.bytes + hop.bytes(), ..way }, |_| Step::Go(hop));
        }
    }

    /// Erases to the end of the line (EL). The paper is told before, the terminal's own: not every terminal
    /// erases with another (`bce` of terminfo).
    pub fn erase(&mut self) {
        let clear = |pen: Pen| pen.for_blank(Pen::TERMINAL);
        let take = |way: Way| {
            let pen = clear(way.pen);
            Way { pen, bytes: way.bytes + way.pen.distance(pen) + Self::ERASE_BYTES, ..way }
        };
        self.extend(take, Step::Erase);
        self.prune();
    }

    /// Makes it the pen at the end.
    pub fn end_with(&mut self, pen: Pen) {
        let take = |way: Way| Way { pen, bytes: way.bytes + way.pen.distance(pen), ..way };
        self.extend(take, Step::Pen);
        self.prune();
    }

    /// Writes a cell in one of some spellings, with what cannot be seen of its pen as it is or as one of
    /// `coming` has it.
    pub fn put(&mut self, spellings: &(impl Iterator<Item = Spelling<'a>> + Clone), coming: &[Pen]) {
        let before = std::mem::take(&mut self.ways);
        for way in before {
            for spelling in spellings.clone() {
                for hint in std::iter::once(way.pen).chain(coming.iter().copied()) {
                    let pen = spelling.pen(hint);
                    let bytes = way.bytes + way.pen.distance(pen) + spelling.symbol.bytes();
                    self.offer(pen, bytes, Step::Put(pen, spelling.symbol), way.step);
                    if spelling.whole_pen().is_some() {
                        break;
                    }
                }
            }
        }
        self.prune();
    }

    /// Puts the ends aside; what follows goes on from them all the same.
    pub fn put_aside(&self) -> WaysAside {
        WaysAside(self.ways.clone())
    }

    /// Goes on from what was put aside, and gives what has been reached meanwhile.
    pub fn swap(&mut self, aside: WaysAside) -> WaysAside {
        WaysAside(std::mem::replace(&mut self.ways, aside.0))
    }

    /// Takes the other ways in as well: they have come to the same place.
    pub fn join(&mut self, others: WaysAside) {
        for other in others.0 {
            match self.ways.iter_mut().find(|way| way.pen == other.pen) {
                Some(way) if other.bytes < way.bytes => *way = other,
                Some(_) => {}
                None => self.ways.push(other),
            }
        }
        self.prune();
    }

    /// Appends the shortest way, and gives the pen at its end.
    pub fn write(&self, line: &mut String) -> Pen {
        let mut pen = self.begin;
        let Some(best) = self.ways.iter().min_by_key(|way| way.bytes) else { return pen };
        let mut steps = Vec::new();
        let mut at = best.step;
        while let Some((step, before)) = self.steps.get(at) {
            steps.push(*step);
            at = *before;
        }
        let begin = line.len();
        for step in steps.into_iter().rev() {
            match step {
                Step::Go(hop) => hop.put(line),
                Step::Pen(next) => pen.change_to(next, line),
                Step::Put(next, symbol) => {
                    pen.change_to(next, line);
                    symbol.put(line);
                }
                Step::Erase(next) => {
                    pen.change_to(next, line);
                    line.push_str(ERASE);
                }
            }
        }
        debug_assert_eq!(line.len() - begin, best.bytes as usize);
        pen
    }

    /// Each way goes on by one step.
    fn extend(&mut self, take: impl Fn(Way) -> Way, step: impl Fn(Pen) -> Step<'a>) {
        let before = std::mem::take(&mut self.ways);
        for way in before {
            let Way { pen, bytes, .. } = take(way);
            self.offer(pen, bytes, step(pen), way.step);
        }
    }

    /// Keeps a way where no other comes to its pen in as few bytes.
    fn offer(&mut self, pen: Pen, bytes: u32, step: Step<'a>, before: usize) {
        let known = self.ways.iter().position(|way| way.pen == pen);
        if known.is_some_and(|place| self.ways[place].bytes <= bytes) {
            return;
        }
        let way = Way { pen, bytes, step: self.steps.len() };
        self.steps.push((step, before));
        match known {
            Some(place) => self.ways[place] = way,
            None => self.ways.push(way),
        }
    }

    /// Leaves out each way whose pen the best can change to and still be no longer: whatever follows is no
    /// longer after that.
    fn prune(&mut self) {
        let Some(best) = self.ways.iter().copied().min_by_key(|way| way.bytes) else { return };
        self.ways.retain(|way| way.pen == best.pen || way.bytes < best.bytes + best.pen.distance(way.pen));
        if self.ways.len() > MOST {
            self.ways.sort_by_key(|way| way.bytes);
            self.ways.truncate(MOST);
        }
    }
}

const ERASE: &str = "\x1b[K";
