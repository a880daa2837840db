//! A sweep over the knobs.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use ray13::frame::Request;
use ray13::math::Size;
use ray13::plan::Options;
use ray13::trade::{EyeDistance, KNOBS, NothingMeasured, Setting, Sweep, SweepLimits, SweepStep};

use super::{given, inside, picture};

/// A picture of eight by four cells: a sweep of all knobs is done long before its time is over.
fn base() -> (ray13::frame::Studio, Request) {
    let studio = inside("hanyang");
    let request = Request { options: Options::default(), ..picture(&studio, Size::new(16, 16)) };
    (studio, request)
}

fn limits(time: Duration) -> SweepLimits {
    SweepLimits { time, also: Vec::new(), apart: 0.01, rays: Some(16), eye: EyeDistance::default() }
}

#[test]
fn every_knob_is_turned_and_its_settings_are_told_from_others() {
    let (studio, base) = base();
    let sweep =
        Sweep::new(&studio, &base, &limits(Duration::from_secs(600)), &AtomicBool::new(false), &mut |_| ())
            .unwrap();
    assert!(!sweep.interrupted);
    let own = Setting::of(&base);
    assert_eq!(sweep.all[0].setting, own);
    let single = std::thread::available_parallelism().map_or(1, usize::from) == 1;
    for knob in KNOBS.iter().filter(|knob| knob.name != "threads" || !single) {
        assert!(sweep.all.iter().any(|one| knob.differs(&one.setting, &own)), "{} stays", knob.name);
    }
    for (place, one) in sweep.all.iter().enumerate() {
        assert!(one.times.all().len() >= 3);
        assert!(!sweep.all[..place].iter().any(|other| other.setting == one.setting));
    }
    let others = sweep.all.iter().filter(|one| one.is_another_picture);
    let others: Vec<String> = others.map(|one| one.setting.arguments(&own)).collect();
    // The scene has no `world(k = …)`; so its models 1 and 2 are one.
    assert!(
        ["--shading 1", "--shading 2", "--shading 3", "--no-shadows", "--depth 0"]
            .iter()
            .all(|other| others.iter().any(|found| found == other)),
        "{others:?}"
    );
    let front = sweep.front();
    assert!(!front.is_empty());
    let costs: Vec<_> =
        front.iter().map(|&place| (sweep.all[place].cost(), sweep.all[place].wrong())).collect();
    assert!(costs.windows(2).all(|pair| pair[0].0 <= pair[1].0 && pair[0].1 > pair[1].1), "{costs:?}");
}

/// Without mirrors and shadows to lose, their switches change nothing, and are no other picture.
#[test]
fn what_a_scene_does_not_have_is_no_other_picture() {
    let studio = given("material(ks = 0) sphere(1);");
    let base = picture(&studio, Size::new(16, 16));
    let sweep =
        Sweep::new(&studio, &base, &limits(Duration::from_secs(600)), &AtomicBool::new(false), &mut |_| ())
            .unwrap();
    assert!(sweep.all.len() > 10 && sweep.all.iter().all(|one| !one.is_another_picture));
}

/// Whatever its time, a setting's accuracy is the same.
#[test]
fn accuracy_is_no_matter_of_chance() {
    let (studio, base) = base();
    let quick =
        || Sweep::new(&studio, &base, &limits(Duration::ZERO), &AtomicBool::new(false), &mut |_| ()).unwrap();
    let [one, other] = [quick(), quick()];
    assert_eq!(one.all.len(), 1);
    assert_eq!(one.all[0].accuracy, other.all[0].accuracy);
    assert_eq!(one.all[0].times.all().len(), 3);
}

#[test]
fn an_interrupt_gives_what_there_is() {
    let (studio, base) = base();
    let interrupt = AtomicBool::new(false);
    let mut watch = |step: SweepStep| {
        if step == SweepStep::Settings(3) {
            interrupt.store(true, Ordering::Relaxed);
        }
    };
    let sweep = Sweep::new(&studio, &base, &limits(Duration::from_secs(600)), &interrupt, &mut watch);
    let sweep = sweep.unwrap();
    assert!(sweep.interrupted);
    assert_eq!(sweep.all.len(), 3);
    let interrupt = AtomicBool::new(true);
    let none = Sweep::new(&studio, &base, &limits(Duration::from_secs(600)), &interrupt, &mut |_| ());
    assert_eq!(none.unwrap_err(), NothingMeasured::Interrupted);
}

/// `--seconds 3` took 47: the time was asked for between pictures alone.
#[test]
fn the_end_of_the_time_and_an_interrupt_end_a_picture_in_hand() {
    let studio = inside("glass");
    // Minutes of rays for the reference.
    let base = picture(&studio, Size::new(1024, 1024));
    let none = |limits, interrupt: &AtomicBool| {
        Sweep::new(&studio, &base, &limits, interrupt, &mut |_| ()).unwrap_err()
    };
    let short = SweepLimits { rays: None, ..limits(Duration::from_millis(20)) };
    assert_eq!(none(short, &AtomicBool::new(false)), NothingMeasured::OutOfTime);
    let interrupt = AtomicBool::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            std::thread::sleep(Duration::from_millis(20));
            interrupt.store(true, Ordering::Relaxed);
        });
        assert_eq!(none(limits(Duration::from_secs(600)), &interrupt), NothingMeasured::Interrupted);
    });
}
