//! What a word makes of its children, once they are figures or solids of facets.

use super::Builder;
use super::arguments::refuse;
use super::form::Form;
use super::lost::Lost;
use super::origin::Origin;
use super::pieces::{Piece, corners, united};
use crate::math::{Bounds, DAffine3, DVec3};
use crate::scene::language::vocabulary::OperatorWord;
use crate::scene::profile::{
    Figure, FigureOperator, Join, NoRevolution, NoSum, NotCarved, Region, Revolution, combined, grown,
    hull_of_figures, hull_of_solid, of_mesh, section, shadow, sum_of_figures, sum_of_solids, united_meshes,
};
use crate::scene::{Diagnostic, Shape, Solid};

impl Builder {
    /// What is made of the pieces that take part, which are all figures or all solids.
    pub(super) fn made(&mut self, form: &Form, pieces: Vec<Piece>, origin: Origin) -> Result<Piece, Lost> {
        let (mut figures, mut solids) = (Vec::new(), Vec::new());
        for piece in pieces {
            match piece {
                Piece::Figure(figure) => figures.push(figure),
                Piece::Solid(solid) => solids.push(solid),
            }
        }
        let is_flat = solids.is_empty();
        if !matches!(form, Form::Operator(_)) || is_flat {
            let of_figures = figures.iter().map(Figure::count).sum::<usize>();
            let count = of_figures + solids.iter().map(count_of_corners).sum::<usize>();
            // A corner that ends up in a hull takes longer than a sum that does not.
            self.spend(count.saturating_mul(3), origin)?;
        }
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
            Form::Minkowski if is_flat => self.sum_of_figures(figures, origin),
            Form::Minkowski => self.sum_of_solids(&solids, origin),
            Form::Grown(by, join) => self.grown(&figures, *by, *join, origin),
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
            Form::Turned(revolution) => self.turned(&figures, revolution, origin),
            Form::Section => section(&united(solids)).map(Piece::Figure).map_err(|_| self.tangled(origin)),
            Form::Shadow => {
                let meshes = self.united_meshes(&united(solids), origin)?;
                let shadow = shadow(&meshes, &mut self.work);
                shadow.map(Piece::Figure).map_err(|_| self.too_much_work(origin))
            }
            Form::Resize(size, auto) if is_flat => {
                let figure = self.figure_of(FigureOperator::Union, &figures, origin)?;
                let bounds = figure.bounds();
                Ok(resized(Piece::Figure(figure), &bounds, *size, *auto))
            }
            Form::Resize(size, auto) => {
                let solid = united(solids);
                // What is scaled is the solid as it is; of its surface only the bounds are asked.
                let bounds = Bounds::around(corners(&self.united_meshes(&solid, origin)?));
                Ok(resized(Piece::Solid(solid), &bounds, *size, *auto))
            }
        }
    }

    fn sum_of_figures(&mut self, figures: Vec<Figure>, origin: Origin) -> Result<Piece, Lost> {
        let mut figures = figures.into_iter();
        let first = figures.next().unwrap_or_default();
        let sum = figures
            .try_fold(first, |sum, next| sum_of_figures(&sum, &next, &mut self.clipper, &mut self.work));
        sum.map(Piece::Figure).map_err(|_| self.too_much_work(origin))
    }

    fn sum_of_solids(&mut self, solids: &[Solid], origin: Origin) -> Result<Piece, Lost> {
        let solids: Result<Vec<Solid>, Lost> =
            solids.iter().map(|solid| self.united_meshes(solid, origin)).collect();
        let mut solids = solids?.into_iter();
        let first = solids.next().unwrap_or(Solid::Union(Vec::new()));
        let sum = solids.try_fold(first, |sum, next| sum_of_solids(&sum, &next, &mut self.work));
        sum.map(|sum| Piece::Solid(united(vec![sum]))).map_err(|why| match why {
            NoSum::TooMuch => self.too_much_work(origin),
            NoSum::NotWorkedOut => self.not_yet("the sum of its children is not worked out", origin),
        })
    }

    fn grown(&mut self, figures: &[Figure], by: f64, join: Join, origin: Origin) -> Result<Piece, Lost> {
        let figure = self.figure_of(FigureOperator::Union, figures, origin)?;
        let sides = match join {
            // A corner's arc has as many sides as the tolerance asks of a circle.
            Join::Round(tolerance) => {
                let cosine = (1.0 - tolerance / by.abs()).clamp(-1.0, 1.0);
                std::f64::consts::PI / libm::acos(cosine).max(1e-9)
            }
            Join::Sharp | Join::Chamfered => 2.0,
        };
        self.check_corners(figure.count() as f64 * 2.0 + sides, origin)?;
        if by == 0.0 { Ok(Piece::Figure(figure)) } else { Ok(Piece::Figure(grown(&figure, by, join))) }
    }

    fn turned(&mut self, figures: &[Figure], revolution: &Revolution, origin: Origin) -> Result<Piece, Lost> {
        let figure = self.figure_of(FigureOperator::Union, figures, origin)?;
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

    fn figure_of(
        &mut self,
        operator: FigureOperator,
        figures: &[Figure],
        origin: Origin,
    ) -> Result<Figure, Lost> {
        combined(operator, figures).map_err(|_| self.tangled(origin))
    }

    fn hull(&mut self, solid: &Solid, origin: Origin) -> Result<Piece, Lost> {
        let meshes = self.united_meshes(solid, origin)?;
        Ok(Piece::Solid(hull_of_solid(&meshes).map_or(Solid::Union(Vec::new()), Solid::Primitive)))
    }

    /// A solid of facets as a union of meshes.
    fn united_meshes(&mut self, solid: &Solid, origin: Origin) -> Result<Solid, Lost> {
        united_meshes(solid, &mut self.work).map_err(|why| match why {
            NotCarved::TooMuch => self.too_much_work(origin),
            NotCarved::Failed => self.not_yet("the surface of what is cut in it is not worked out", origin),
        })
    }

    /// Takes steps from those that the scene may take.
    fn spend(&mut self, steps: usize, origin: Origin) -> Result<(), Lost> {
        self.work.spend(steps).map_err(|_| self.too_much_work(origin))
    }

    /// The error of what takes longer than a scene may.
    fn too_much_work(&mut self, origin: Origin) -> Lost {
        let why = "what the scene makes of corners would take too long";
        let help = "make curves coarser, by $fn or $fs, or have OpenSCAD make a mesh of it";
        self.can_not_be_shown(why, help, origin)
    }
}

/// How many corners the meshes of a solid have.
fn count_of_corners(solid: &Solid) -> usize {
    let mut count = 0;
    solid.visit(&mut |primitive| {
        if let Shape::Mesh(mesh) = &primitive.shape {
            count += mesh.points.len();
        }
    });
    count
}

/// A piece that reaches as far as `bounds` scaled to a size.
fn resized(piece: Piece, bounds: &Bounds, size: DVec3, auto: [bool; 3]) -> Piece {
    let own = bounds.half() * 2.0;
    let factor = |axis: usize| if own[axis] > 0.0 { size[axis] / own[axis] } else { 1.0 };
    let largest = (0..3).fold(0, |best, axis| if size[axis] > size[best] { axis } else { best });
    let factors = DVec3::from_array([0, 1, 2].map(|axis| match size[axis] {
        0.0 if auto[axis] && size[largest] > 0.0 => factor(largest),
        0.0 => 1.0,
        _ => factor(axis),
    }));
    piece.mapped(&DAffine3::from_scale(factors)).unwrap_or_else(|| Piece::Figure(Figure::default()))
}
