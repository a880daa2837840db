//! F6: the measured trade of time for accuracy, with the present setting on it.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear, Widget};

use super::actions::Action;
use super::theme::Theme;
use crate::trade::{Setting, Sweep, SweepStep, TradePlot};
use crate::widget::TradePlotWidget;

/// The trade of a picture, as far as it is measured.
#[derive(Clone, Debug, PartialEq)]
pub enum TradePanel {
    /// It is being measured.
    Measuring(Option<SweepStep>),
    /// It is measured.
    Measured(TradeFigures),
    /// It was given up, or there was no time.
    Nothing,
}

/// What was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct TradeFigures {
    plot: TradePlot,
    /// All settings, the one that was asked for first: each with its milliseconds and its share of wrong
    /// levels.
    settings: Vec<(Setting, f64, f64)>,
    /// Whether it was given up before its time.
    interrupted: bool,
}

impl TradeFigures {
    /// Of what was measured.
    pub fn new(sweep: &Sweep) -> Self {
        let told =
            |one: &crate::trade::Measurement| (one.setting, one.cost().as_secs_f64() * 1e3, one.wrong());
        Self {
            plot: TradePlot::new(sweep),
            settings: sweep.all.iter().map(told).collect(),
            interrupted: sweep.interrupted,
        }
    }

    /// Goes to the next setting of the front that is slower, or faster; stays where there is none.
    fn go(&mut self, slower: bool) {
        let front = &self.plot.front;
        let present = self.plot.present;
        let next = match front.iter().position(|&place| place == present) {
            Some(place) if slower => front.get(place + 1),
            Some(place) => place.checked_sub(1).and_then(|place| front.get(place)),
            // From a setting that others beat, to the next that is slower, or faster.
            None => {
                let time = self.settings[present].1;
                let is_beyond = |place: &&usize| (self.settings[**place].1 > time) == slower;
                if slower { front.iter().find(is_beyond) } else { front.iter().rfind(is_beyond) }
            }
        };
        self.plot.present = next.copied().unwrap_or(present);
    }

    /// What the present setting costs, in words.
    fn line(&self) -> String {
        let (setting, ms, wrong) = &self.settings[self.plot.present];
        let options = setting.arguments(&self.settings[0].0);
        let options = if options.is_empty() { "as asked" } else { &options };
        let stopped = if self.interrupted { "  (stopped early)" } else { "" };
        format!("{ms:.1} ms, {:.2} % of levels wrong: {options}{stopped}", wrong * 100.0)
    }
}

impl TradePanel {
    /// Does what an arrow asks for here; gives whether that is so. Other actions are not this one's.
    pub fn takes(&mut self, action: Action) -> bool {
        let Self::Measured(figures) = self else { return false };
        match action {
            Action::OrbitLeft => figures.go(false),
            Action::OrbitRight => figures.go(true),
            _ => return false,
        }
        true
    }

    /// The setting that the arrows have gone to.
    pub fn present(&self) -> Option<Setting> {
        match self {
            Self::Measured(figures) => Some(figures.settings[figures.plot.present].0),
            Self::Measuring(_) | Self::Nothing => None,
        }
    }

    /// Draws it over the lower part of an area; gives its place.
    pub fn draw(&self, theme: &Theme, area: Rect, buffer: &mut Buffer) -> Rect {
        // The plot wants ten rows; the picture that is talked of stays in sight above.
        let height = (area.height * 3 / 5).max(13).min(area.height);
        let place = Rect { y: area.bottom() - height, height, ..area };
        Clear.render(place, buffer);
        let block = Block::bordered()
            .title(Span::styled(" TRADE of time for accuracy ", theme.bright))
            .title_bottom(Line::from(" ← faster  more accurate →  Esc ").right_aligned())
            .style(theme.text);
        let inside = block.inner(place);
        block.render(place, buffer);
        let figures = match self {
            Self::Measured(figures) => figures,
            Self::Measuring(step) => {
                Line::from(format!(" {}", words(*step))).render(inside, buffer);
                return place;
            }
            Self::Nothing => {
                Line::from(" nothing was measured: F6 twice begins anew").render(inside, buffer);
                return place;
            }
        };
        let row = Rect { height: 1.min(inside.height), ..inside };
        Line::styled(format!(" ♦ {}", figures.line()), theme.bright).render(row, buffer);
        let plot = Rect { y: inside.y + row.height, height: inside.height - row.height, ..inside };
        TradePlotWidget(&figures.plot).render(plot, buffer);
        theme.take_over(plot, buffer);
        place
    }
}

fn words(step: Option<SweepStep>) -> String {
    match step {
        None => "measuring".to_owned(),
        Some(SweepStep::Reference) => "measuring: the reference".to_owned(),
        Some(SweepStep::Settings(number)) => format!("measuring: {number} settings"),
        Some(SweepStep::Round(number)) => format!("measuring: round {number}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::attributes::text_and_attributes;
    use crate::frame::{Studio, pcat};
    use crate::glyph::Palette;
    use crate::plan::Options;
    use crate::scene::Scene;
    use crate::trade::{LogAxis, PlotPoint};

    /// Four settings: as asked, a faster one, a better one, and one that is beaten.
    fn figures() -> TradeFigures {
        let studio = Studio::new(Scene::default()).unwrap();
        let base = Setting::of(&pcat::request(studio.camera(0, 1.0)));
        let with = |samples| Setting { options: Options { samples, ..base.options }, ..base };
        let settings =
            vec![(base, 10.0, 0.05), (with(2), 30.0, 0.01), (with(3), 80.0, 0.02), (with(4), 100.0, 0.001)];
        let point = |(_, ms, wrong): &(Setting, f64, f64)| PlotPoint {
            time: libm::log10(*ms),
            wrong: libm::log10(wrong * 100.0),
            is_another_picture: false,
        };
        let plot = TradePlot {
            points: settings.iter().map(point).collect(),
            front: vec![0, 1, 3],
            present: 0,
            time: LogAxis { low: 1.0, high: 2.0 },
            wrong: LogAxis { low: -1.0, high: 1.0 },
        };
        TradeFigures { plot, settings, interrupted: false }
    }

    #[test]
    fn arrows_go_along_the_front() {
        let mut panel = TradePanel::Measured(figures());
        let mut samples = Vec::new();
        for action in [Action::OrbitRight, Action::OrbitRight, Action::OrbitRight, Action::OrbitLeft] {
            assert!(panel.takes(action));
            samples.push(panel.present().unwrap().options.samples);
        }
        assert_eq!(samples, [2, 4, 4, 2]);
        assert!(!panel.takes(Action::FlyForward) && !TradePanel::Nothing.takes(Action::OrbitLeft));
        // From one that others beat, to the next on either side.
        for (slower, samples) in [(true, 4), (false, 2)] {
            let mut figures = figures();
            figures.plot.present = 2;
            figures.go(slower);
            assert_eq!(figures.settings[figures.plot.present].0.options.samples, samples);
        }
    }

    #[test]
    fn what_it_looks_like() {
        for (width, height) in [(80, 20), (80, 21), (200, 56)] {
            let area = Rect::new(0, 0, width, height);
            let mut buffer = Buffer::empty(area);
            TradePanel::Measured(figures()).draw(&Theme::of(Palette::DOS), area, &mut buffer);
            insta::assert_snapshot!(format!("trade_at_{width}_by_{height}"), text_and_attributes(&buffer));
        }
    }

    #[test]
    fn no_area_is_too_small() {
        for panel in [TradePanel::Measured(figures()), TradePanel::Measuring(None), TradePanel::Nothing] {
            for (width, height) in [(0, 0), (1, 1), (5, 3), (40, 2), (300, 100)] {
                let area = Rect::new(0, 0, width, height);
                let place = panel.draw(&Theme::of(Palette::MONO), area, &mut Buffer::empty(area));
                assert_eq!(place.intersection(area), place);
            }
        }
    }
}
