//! What one setting costs and what it is worth.

use std::time::Duration;

use crate::frame::{Frame, Request, Studio, Wants};
use crate::stage::GiveUp;

use super::knobs::KNOBS;
use super::layers::Accuracy;
use super::reference::{Reference, turned_of};
use super::setting::Setting;
use super::timing::Times;

/// What one setting costs and what it is worth.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// Where the knobs stand.
    pub setting: Setting,
    /// How long its picture takes.
    pub times: Times,
    /// How far its picture is from the reference.
    pub accuracy: Accuracy,
    /// Whether it shows something else than the request on purpose, and does.
    pub is_another_picture: bool,
    /// How many knobs stand elsewhere than in the request.
    pub turned: usize,
}

/// The pictures of a setting that are compared.
#[derive(Debug)]
pub(super) struct ComparedPictures {
    setting: Setting,
    request: Request,
    frame: Frame,
    /// From the view that is turned by a tenth of a dot; of a picture with characters.
    moved: Option<Frame>,
}

impl ComparedPictures {
    /// Draws those of a setting; `None` where that is given up.
    pub fn draw(studio: &Studio, base: &Request, setting: Setting, give_up: &GiveUp) -> Option<Self> {
        let request = setting.request(base);
        let frame = studio.draw_anew_unless(&with_all(&request), give_up)?;
        let moved = if request.wants.cells {
            Some(studio.draw_anew_unless(&turned_of(base, &request), give_up)?)
        } else {
            None
        };
        Some(Self { setting, request, frame, moved })
    }
}

impl Measurement {
    /// Compares the pictures of a setting; `own` is that of the request's own. It has no times yet. `None`
    /// where it is given up: what is another picture takes a third one to tell.
    pub(super) fn new(
        studio: &Studio,
        reference: &Reference,
        pictures: &ComparedPictures,
        own: Option<&Self>,
        give_up: &GiveUp,
    ) -> Option<Self> {
        let ComparedPictures { setting, request, frame, moved } = pictures;
        let (base, setting) = (reference.base(), *setting);
        let accuracy = reference.accuracy(request, frame, moved.as_ref());
        // A scene without mirrors shows the same without mirror rays.
        let is_another_picture = match own.filter(|_| setting.shows_another_picture(&Setting::of(base))) {
            None => false,
            Some(own) => {
                // What else it changes is not meant: the picture without that says.
                let meant_alone = setting.what_is_meant(&Setting::of(base));
                let light = if meant_alone == setting {
                    accuracy.light
                } else {
                    let request = meant_alone.request(base);
                    let frame = studio.draw_anew_unless(&with_all(&request), give_up)?;
                    reference.accuracy(&request, &frame, None).light
                };
                own.accuracy.light != light
            }
        };
        let own = Setting::of(base);
        let turned = KNOBS.iter().filter(|knob| knob.differs(&setting, &own)).count();
        Some(Self { setting, times: Times::default(), accuracy, is_another_picture, turned })
    }

    /// Draws the picture once more, as it was asked for, and takes its time, unless it is given up; gives
    /// whether it did.
    pub fn time(&mut self, studio: &Studio, base: &Request, give_up: &GiveUp) -> bool {
        let frame = studio.draw_anew_unless(&self.setting.request(base), give_up);
        self.times.extend(frame.iter().map(|frame| frame.total));
        frame.is_some()
    }

    /// Its time: the median.
    pub fn cost(&self) -> Duration {
        self.times.median()
    }

    /// Whether its time is not told from that of another: the times in which the middle half of the pictures
    /// of each lie have some in common.
    pub fn is_as_fast_as(&self, other: &Self) -> bool {
        let [own, other] = [self, other].map(|one| one.times.middle_half());
        own[0] <= other[1] && other[0] <= own[1]
    }

    /// The share of dots with a wrong level, 0 to 1.
    pub fn wrong(&self) -> f64 {
        self.accuracy.light.wrong()
    }
}

/// A request of all that is compared.
fn with_all(request: &Request) -> Request {
    Request { wants: Wants { cells: request.wants.cells, ..Wants::ALL }, ..request.clone() }
}
