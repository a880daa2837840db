//! The words that make something new of what their children are.

use super::Builder;
use super::arguments::{BoundArguments, refuse};
use super::context::{Context, FormSpace};
use super::form::Form;
use super::frame::OpenCall;
use super::lost::Lost;
use super::origin::Origin;
use super::pieces::{Made, Piece, corners, united};
use crate::math::{Bounds, DAffine3, DMat3, DVec2, DVec3};
use crate::scene::diagnostic::Sink;
use crate::scene::language::syntax::TextSpan;
use crate::scene::language::vocabulary::{FormWord, Meaning, OperatorWord, Word};
use crate::scene::profile::{
    Figure, FigureOperator, Fragments, Join, LinearSweep, NoRevolution, NoShadow, NoSum, Region, Revolution,
    combined, grown, hull_of_figures, hull_of_solid, of_mesh, section, shadow, sum_of_figures, sum_of_solids,
};
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
    Ok(LinearSweep { bottom, top, twist, scale, slices, fragments })
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

    fn made(&mut self, form: &Form, pieces: Vec<Piece>, origin: Origin) -> Result<Piece, Lost> {
        let (mut figures, mut solids) = (Vec::new(), Vec::new());
        for piece in pieces {
            match piece {
                Piece::Figure(figure) => figures.push(figure),
                Piece::Solid(solid) => solids.push(solid),
            }
        }
        let is_flat = solids.is_empty();
        match form {
            Form::Operator(operator) if is_flat => {
                let operator = match operator {
                    OperatorWord::Union => FigureOperator::Union,
                    OperatorWord::Intersection => FigureOperator::Intersection,
                    OperatorWord::Difference => FigureOperator::Difference,
                };
                self.figure_of(operator, &figures, origin).map(Piece::Figure)
            }
            Form::Operator(operator) => Ok(Piece::Solid(match operator {
                _ if solids.len() == 1 => united(solids),
                OperatorWord::Union => Solid::Union(solids),
                OperatorWord::Intersection => Solid::Intersection(solids),
                OperatorWord::Difference => Solid::Difference(solids),
            })),
            Form::Hull if is_flat => Ok(Piece::Figure(hull_of_figures(&figures).unwrap_or_default())),
            Form::Hull => self.hull(&united(solids), origin),
            Form::Minkowski if is_flat => {
                let mut figures = figures.into_iter();
                let first = figures.next().unwrap_or_default();
                let sum = figures.try_fold(first, |sum, next| sum_of_figures(&sum, &next, &mut self.clipper));
                sum.map(Piece::Figure).ok_or_else(|| self.too_many(origin))
            }
            Form::Minkowski => {
                let mut solids = solids.into_iter();
                let first = solids.next().unwrap_or(Solid::Union(Vec::new()));
                let sum = solids.try_fold(first, |sum, next| sum_of_solids(&sum, &next));
                sum.map(|sum| Piece::Solid(united(vec![sum]))).map_err(|why| match why {
                    NoSum::TooMany => self.too_many(origin),
                    NoSum::NotConvex => self.not_yet("neither of the two that it adds is convex", origin),
                })
            }
            Form::Grown(by, join) => {
                let figure = self.figure_of(FigureOperator::Union, &figures, origin)?;
                let sides = match join {
                    // A corner's arc has as many sides as the tolerance asks of a circle.
                    Join::Round(tolerance) => {
                        let cosine = (1.0 - tolerance / by.abs()).clamp(-1.0, 1.0);
                        std::f64::consts::PI / libm::acos(cosine).max(1e-9)
                    }
                    Join::Sharp | Join::Chamfered => 2.0,
                };
                self.check_corners(figure.count() as f64 * 2.0 + sides, origin)?;
                if *by == 0.0 {
                    Ok(Piece::Figure(figure))
                } else {
                    Ok(Piece::Figure(grown(&figure, *by, *join)))
                }
            }
            Form::Fill => {
                let figure = self.figure_of(FigureOperator::Union, &figures, origin)?;
                let error = figure.error;
                let whole = |region: Region| Figure { error, ..Figure::convex(region.outer) };
                let wholes: Vec<Figure> = figure.regions.into_iter().map(whole).collect();
                self.figure_of(FigureOperator::Union, &wholes, origin).map(Piece::Figure)
            }
            Form::Linear(sweep, lean) => {
                let figure = self.figure_of(FigureOperator::Union, &figures, origin)?;
                let mesh = sweep.mesh(&figure, &mut self.clipper).ok_or_else(|| self.too_many(origin))?;
                self.check_corners(mesh.points.len() as f64, origin)?;
                let stretch = sweep.scale.max_element().max(1.0);
                let error = DVec3::new(1.0, 1.0, 0.0) * (figure.error * stretch);
                let swept = Solid::Primitive(of_mesh(mesh).with_map_error(error));
                Piece::Solid(swept).mapped(lean).ok_or(Lost::Empty)
            }
            Form::Turned(revolution) => {
                let figure = self.figure_of(FigureOperator::Union, &figures, origin)?;
                let mesh = revolution.mesh(&figure, &mut self.clipper).map_err(|why| match why {
                    NoRevolution::TooMany => self.too_many(origin),
                    NoRevolution::Crosses => {
                        let message = "the figure lies on both sides of the axis, x = 0";
                        let error = Diagnostic::error(origin.name, message);
                        refuse(origin.word, error, Lost::Empty, &mut self.sink)
                    }
                })?;
                let error = DVec3::splat(figure.error);
                Ok(Piece::Solid(Solid::Primitive(of_mesh(mesh).with_map_error(error))))
            }
            Form::Section => section(&united(solids)).map(Piece::Figure).map_err(|_| self.tangled(origin)),
            Form::Shadow => shadow(&united(solids)).map(Piece::Figure).map_err(|why| match why {
                NoShadow::TooMany => self.too_many(origin),
                NoShadow::Cut => self.not_yet("the shadow of what is cut is not worked out", origin),
            }),
            Form::Resize(size, auto) => Ok(resized(&figures, solids, *size, *auto)),
        }
    }

    fn figure_of(
        &mut self,
        operator: FigureOperator,
        figures: &[Figure],
        origin: Origin,
    ) -> Result<Figure, Lost> {
        combined(operator, figures).map_err(|_| self.tangled(origin))
    }

    fn hull(&mut self, solid: &Solid, origin: Origin) -> Result<Piece, Lost> {
        let mut is_union = true;
        solid.fold(&mut |_| (), &mut |solid, _| is_union &= matches!(solid, Solid::Union(_)));
        if !is_union {
            return Err(self.not_yet("the hull of what is cut is not worked out", origin));
        }
        Ok(Piece::Solid(match hull_of_solid(solid) {
            Some(mesh) => Solid::Primitive(of_mesh(mesh)),
            None => Solid::Union(Vec::new()),
        }))
    }

    /// The error of what a word can not do.
    fn not_yet(&mut self, why: &str, origin: Origin) -> Lost {
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

/// Pieces scaled to a size.
fn resized(figures: &[Figure], solids: Vec<Solid>, size: DVec3, auto: [bool; 3]) -> Piece {
    let bounds = figures.iter().fold(Bounds::EMPTY, |all, figure| all.join(&figure.bounds()));
    let bounds = solids.iter().fold(bounds, |all, solid| all.join(&Bounds::around(corners(solid))));
    let own = bounds.half() * 2.0;
    let factor = |axis: usize| if own[axis] > 0.0 { size[axis] / own[axis] } else { 1.0 };
    let largest = (0..3).fold(0, |best, axis| if size[axis] > size[best] { axis } else { best });
    let factors = DVec3::from_array([0, 1, 2].map(|axis| match size[axis] {
        0.0 if auto[axis] && size[largest] > 0.0 => factor(largest),
        0.0 => 1.0,
        _ => factor(axis),
    }));
    let map = DAffine3::from_scale(factors);
    let scaled = if solids.is_empty() {
        let figure = combined(FigureOperator::Union, figures).unwrap_or_default();
        Piece::Figure(figure).mapped(&map)
    } else {
        Piece::Solid(united(solids)).mapped(&map)
    };
    scaled.unwrap_or_else(|| Piece::Figure(Figure::default()))
}
