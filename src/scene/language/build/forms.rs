//! The words that make something new of what their children are.

use super::Builder;
use super::arguments::BoundArguments;
use super::context::{Context, FormSpace};
use super::form::Form;
use super::frame::OpenCall;
use super::lost::Lost;
use super::origin::Origin;
use super::pieces::{Made, Piece};
use crate::math::{DAffine3, DMat3, DVec2, DVec3};
use crate::scene::diagnostic::Sink;
use crate::scene::language::syntax::TextSpan;
use crate::scene::language::vocabulary::{FormWord, Meaning, OperatorWord, Word};
use crate::scene::profile::{Fragments, Join, LinearSweep, Revolution};
use crate::scene::{Diagnostic, Solid};

/// The way along z of a `linear_extrude`.
pub fn sweep(
    arguments: &BoundArguments<'_, '_>,
    fragments: Fragments,
    sink: &mut Sink,
) -> Result<LinearSweep, Lost> {
    let height = arguments.number("height", sink)?.unwrap_or(100.0);
    let (bottom, top) =
        if arguments.flag("center", sink)? { (-0.5 * height, 0.5 * height) } else { (0.0, height) };
    let twist = arguments.number("twist", sink)?.unwrap_or(0.0);
    let scale = arguments.triple("scale", 1.0, sink)?.unwrap_or(DVec3::ONE).truncate();
    let slices = arguments.number("slices", sink)?;
    let segments = arguments.number("segments", sink)?;
    Ok(LinearSweep { bottom, top, twist, scale, slices, segments, fragments })
}

/// How a `linear_extrude` leans: its way is along `v`, and as long as it is high.
pub fn lean(arguments: &BoundArguments<'_, '_>, sink: &mut Sink) -> Result<DAffine3, Lost> {
    let way = arguments.triple("v", 0.0, sink)?.unwrap_or(DVec3::Z);
    let Some(way) = way.try_normalize().filter(|way| way.z > 0.0) else {
        let error = Diagnostic::error(arguments.place_of("v"), "`v` of `linear_extrude` must lead upwards");
        return Err(arguments.refuse(error, Lost::Empty, sink));
    };
    Ok(DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::Y, way)))
}

impl Builder {
    /// What a call makes of its children; none where they are left as they are.
    pub(super) fn form(
        &mut self,
        word: &'static Word,
        arguments: &BoundArguments<'_, '_>,
        above: &Context,
        place: TextSpan,
    ) -> Result<Option<Form>, Lost> {
        let is_faceted = above.space == FormSpace::Faceted;
        let sink = &mut self.sink;
        let kind = match word.meaning {
            Meaning::Form(kind) => kind,
            Meaning::Operator(operator) if is_faceted => return Ok(Some(Form::Operator(operator))),
            _ if is_faceted => return Ok(Some(Form::Operator(OperatorWord::Union))),
            _ => return Ok(None),
        };
        let fragments = arguments.fragments(above.fragments);
        let is_solid = matches!(kind, FormWord::LinearExtrude | FormWord::RotateExtrude);
        if is_solid && matches!(above.space, FormSpace::Extruded { .. }) {
            let message = format!("`{}` is a solid among figures, and left out", word.name);
            sink.note(Diagnostic::note(place, message));
            return Err(Lost::Empty);
        }
        Ok(Some(match kind {
            FormWord::LinearExtrude => {
                let sweep = sweep(arguments, fragments, sink)?;
                if !is_faceted && sweep.twist == 0.0 && sweep.scale == DVec2::ONE {
                    return Ok(None);
                }
                Form::Linear(sweep, lean(arguments, sink)?)
            }
            FormWord::RotateExtrude => {
                let angle = arguments.number("angle", sink)?.unwrap_or(360.0);
                if angle == 0.0 {
                    let error =
                        Diagnostic::error(arguments.place_of("angle"), "an angle of 0 sweeps nothing");
                    return Err(arguments.refuse(error, Lost::Empty, sink));
                }
                Form::Turned(Revolution { angle, start: arguments.number("start", sink)?, fragments })
            }
            FormWord::Hull => Form::Hull,
            FormWord::Minkowski => Form::Minkowski,
            FormWord::Fill => Form::Fill,
            FormWord::Offset => {
                let (delta, chamfer) = (arguments.number("delta", sink)?, arguments.flag("chamfer", sink)?);
                match (arguments.number("r", sink)?, delta) {
                    (None, Some(delta)) if chamfer => Form::Grown(delta, Join::Chamfered),
                    (None, Some(delta)) => Form::Grown(delta, Join::Sharp),
                    (r, _) => {
                        let r = r.unwrap_or(1.0);
                        let side = std::f64::consts::PI / fragments.of_circle(r.abs());
                        Form::Grown(r, Join::Round(r.abs() * (1.0 - libm::cos(side))))
                    }
                }
            }
            FormWord::Projection => {
                if arguments.flag("cut", sink)? {
                    Form::Section
                } else {
                    Form::Shadow
                }
            }
            FormWord::Resize => {
                let size = arguments.triple("newsize", 0.0, sink)?.unwrap_or(DVec3::ZERO);
                Form::Resize(size, arguments.flags("auto", sink)?)
            }
        }))
    }

    /// What is made of the children of a call that ends, as a part of what holds it; and whether a part of it
    /// was left out.
    pub(super) fn formed(
        &mut self,
        form: &Form,
        frame: &OpenCall,
        above: &Context,
        origin: Origin,
    ) -> Result<(Made, bool), Lost> {
        let pieces = self.pieces.split_off(frame.start);
        let any_left_out = frame.any_missing || frame.any_incomplete;
        let none = if any_left_out { Lost::Missing } else { Lost::Empty };
        let is_union =
            matches!(form, Form::Operator(_) | Form::Grown(..) | Form::Linear(..) | Form::Turned(_));
        let lost = match form {
            Form::Operator(OperatorWord::Intersection) if frame.any_empty => Some(Lost::Empty),
            Form::Operator(OperatorWord::Intersection) if frame.any_missing => Some(Lost::Missing),
            Form::Operator(OperatorWord::Difference) if frame.first_lost.is_some() => frame.first_lost,
            _ if any_left_out && !is_union => Some(Lost::Missing),
            _ => pieces.is_empty().then_some(none),
        };
        if let Some(lost) = lost {
            if lost == Lost::Missing && frame.present > 1 {
                self.note_left_out(frame);
                if !is_union && self.sink.is_clean() {
                    let message =
                        format!("`{}` is left out whole: a part of it is missing", origin.word.name);
                    self.sink.note(Diagnostic::note(origin.name, message));
                }
            }
            return Err(lost);
        }
        let pieces = self.of_one_kind(form, pieces, origin);
        let piece = self.made(form, pieces, origin)?;
        let is_nothing = match &piece {
            Piece::Figure(figure) => figure.regions.is_empty(),
            Piece::Solid(Solid::Union(parts)) => parts.is_empty(),
            Piece::Solid(_) => false,
        };
        if is_nothing {
            return Err(none);
        }
        let leaf = match (above.space, form) {
            // The maps above an operator went down to its operands.
            (FormSpace::Faceted, Form::Operator(_)) => Made::Piece(piece),
            (FormSpace::Faceted, _) => Made::Piece(self.placed_piece(piece, above, origin)?),
            _ => Made::Solid(self.shown(piece, above, origin)?),
        };
        Ok((leaf, any_left_out))
    }

    /// The pieces that take part: as in OpenSCAD all are figures, or all are solids.
    fn of_one_kind(&mut self, form: &Form, mut pieces: Vec<Piece>, origin: Origin) -> Vec<Piece> {
        let is_flat = match form {
            Form::Grown(..) | Form::Fill | Form::Linear(..) | Form::Turned(_) => true,
            Form::Section | Form::Shadow => false,
            _ => pieces.first().is_some_and(Piece::is_figure),
        };
        let count = pieces.len();
        pieces.retain(|piece| piece.is_figure() == is_flat);
        if pieces.len() < count {
            let kind = if is_flat { "solids" } else { "figures" };
            let message =
                format!("{kind} within `{}` are left out: it is of the other kind", origin.word.name);
            self.sink.note(Diagnostic::note(origin.name, message));
        }
        pieces
    }

    /// The error of what a word can not do.
    pub(super) fn not_yet(&mut self, why: &str, origin: Origin) -> Lost {
        self.can_not_be_shown(why, "--skip-unsupported shows the rest of the scene", origin)
    }

    /// The same with other advice.
    pub(super) fn can_not_be_shown(&mut self, why: &str, help: &str, origin: Origin) -> Lost {
        let message = format!("`{}` can not be shown: {why}", origin.word.name);
        if self.skip_unsupported {
            self.sink.note(Diagnostic::note(origin.name, message));
            return Lost::Missing;
        }
        self.sink.report(Diagnostic::error(origin.name, message).help(help)).into()
    }
}
