//! The words for plane figures; and words that are figures or solids where facets are wanted of them.

use std::sync::Arc;

use super::arguments::{BoundArguments, numbers};
use super::context::{Context, FormSpace};
use super::lost::Lost;
use super::origin::Origin;
use super::pieces::{Made, Piece, moved, rebuilt};
use super::solids::{placed, radius};
use super::{Builder, facets};
use crate::math::{DAffine3, DVec2, DVec3};
use crate::scene::diagnostic::Sink;
use crate::scene::language::syntax::{Call, Spanned, Value};
use crate::scene::language::vocabulary::{FigureWord, Meaning, SolidWord, Word};
use crate::scene::profile::{Figure, Fragments, MOST_CORNERS, corners, faceted, filled, prism};
use crate::scene::{Diagnostic, FacetMode, MaterialId, Mesh, Primitive, Shape, Solid};

/// Bytes that a corner of a figure takes while it is worked on: in its outline, in the sweep that sorts
/// outlines out, and in triangles.
const OF_FLAT_CORNER: u64 = 600;

/// A figure as it is written.
enum Flat {
    /// A disc of this radius.
    Disc(f64),
    /// A rectangle: its middle and half its sides.
    Rectangle(DVec2, DVec2),
    Outlines(Figure),
}

impl Builder {
    /// What a word without children is.
    pub(super) fn leaf(
        &mut self,
        word: &'static Word,
        call: &Call<'_>,
        context: &Context,
    ) -> Result<Made, Lost> {
        let is_faceted = context.space == FormSpace::Faceted;
        match word.meaning {
            Meaning::Figure(kind) => self.figure(kind, word, call, context),
            Meaning::Import => self.import(word, call, context),
            Meaning::Solid(_) if matches!(context.space, FormSpace::Extruded { .. }) => {
                Err(self.solid_in_drawing(Origin::of(word, call)))
            }
            Meaning::Solid(kind) if is_faceted => self.facets(kind, word, call, context).map(Made::Piece),
            Meaning::Solid(kind) => self.primitive(kind, word, call, context).map(Made::Solid),
            _ => Err(Lost::Missing),
        }
    }

    /// As OpenSCAD does, a solid within a figure goes for nothing.
    fn solid_in_drawing(&mut self, origin: Origin) -> Lost {
        let message = format!("`{}` is a solid among figures, and left out", origin.word.name);
        self.sink.note(Diagnostic::note(origin.name, message));
        Lost::Empty
    }

    fn figure(
        &mut self,
        kind: FigureWord,
        word: &'static Word,
        call: &Call<'_>,
        context: &Context,
    ) -> Result<Made, Lost> {
        let origin = Origin::of(word, call);
        let arguments = BoundArguments::bind(call, word, &mut self.sink)?;
        let fragments = arguments.fragments(context.fragments);
        let flat = match kind {
            FigureWord::Circle => Flat::Disc(radius(&arguments, "d", "r", &mut self.sink)?.unwrap_or(1.0)),
            FigureWord::Square => {
                let size = arguments.triple("size", 1.0, &mut self.sink)?.unwrap_or(DVec3::ONE);
                let half = size.truncate() * 0.5;
                let is_centred = arguments.flag("center", &mut self.sink)?;
                Flat::Rectangle(if is_centred { DVec2::ZERO } else { half }, half)
            }
            FigureWord::Polygon => Flat::Outlines(self.polygon(&arguments, origin)?),
            FigureWord::Text => Flat::Outlines(self.text(&arguments, fragments, origin)?),
        };
        if context.space == FormSpace::Faceted {
            let figure = self.outlined(flat, fragments, origin)?;
            return self.placed_piece(Piece::Figure(figure), context, origin).map(Made::Piece);
        }
        if self.facet_mode == FacetMode::OpenScad && matches!(flat, Flat::Disc(_)) {
            let figure = self.outlined(flat, fragments, origin)?;
            return self.shown(Piece::Figure(figure), context, origin).map(Made::Solid);
        }
        let (bottom, top) = context.space.thickness();
        let (middle, half) = (0.5 * (bottom + top), 0.5 * (top - bottom));
        let (shape, local) = match flat {
            Flat::Disc(radius) => {
                let shape = match facets::sides(fragments) {
                    Some(sides) => self.polygons.cone(sides, 1.0, 1.0),
                    None => Shape::Cone { bottom: 1.0, top: 1.0 },
                };
                (shape, placed(DVec3::new(0.0, 0.0, middle), DVec3::new(radius, radius, half)))
            }
            Flat::Rectangle(at, size) => (Shape::Cube, placed(at.extend(middle), size.extend(half))),
            Flat::Outlines(figure) => {
                return self.shown(Piece::Figure(figure), context, origin).map(Made::Solid);
            }
        };
        let primitive = self.put(shape, local, DVec3::ZERO, context, origin)?;
        self.note_digits(&primitive, &local, context);
        Ok(Made::Solid(Solid::Primitive(primitive)))
    }

    /// The outlines of a figure.
    fn outlined(&mut self, flat: Flat, fragments: Fragments, origin: Origin) -> Result<Figure, Lost> {
        match flat {
            Flat::Disc(radius) => {
                let count = fragments.of_circle(radius);
                self.check_corners(count, origin)?;
                Ok(Figure::convex(corners(radius, count)))
            }
            Flat::Rectangle(at, half) => {
                let signs = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
                Ok(Figure::convex(signs.map(|sign| at + half * DVec2::from(sign)).to_vec()))
            }
            Flat::Outlines(figure) => Ok(figure),
        }
    }

    /// Refuses what would have too many corners.
    pub(super) fn check_corners(&mut self, count: f64, origin: Origin) -> Result<(), Lost> {
        if count > MOST_CORNERS {
            return Err(self.too_many(origin));
        }
        let bytes = count as u64 * OF_FLAT_CORNER;
        if self.memory.has_room_for(bytes) { Ok(()) } else { Err(self.no_room(bytes, origin)) }
    }

    /// The error of what would have too many corners.
    pub(super) fn too_many(&mut self, origin: Origin) -> Lost {
        let error =
            Diagnostic::error(origin.name, format!("it would have more than {MOST_CORNERS:e} corners"));
        let error = error.help("make curves coarser, by $fn or $fs, or take fewer slices");
        super::arguments::refuse(origin.word, error, Lost::Missing, &mut self.sink)
    }

    /// The error of outlines that cross too often.
    pub(super) fn tangled(&mut self, origin: Origin) -> Lost {
        let error = Diagnostic::error(
            origin.name,
            "its outlines are too dense, or cross too often, to be sorted out",
        );
        let error = error.help("leave detail out, or split it");
        super::arguments::refuse(origin.word, error, Lost::Missing, &mut self.sink)
    }

    fn polygon(&mut self, arguments: &BoundArguments<'_, '_>, origin: Origin) -> Result<Figure, Lost> {
        let Some(value) = arguments.value("points") else {
            return Err(arguments.missing("points", &mut self.sink));
        };
        let points = flat_points(value, arguments, &mut self.sink)?;
        let paths = match arguments.value("paths") {
            Some(paths) => chosen(paths, &points, arguments, &mut self.sink)?,
            None => vec![points],
        };
        self.check_corners(paths.iter().map(Vec::len).sum::<usize>() as f64, origin)?;
        filled(&paths, 0.0).map_err(|_| self.tangled(origin))
    }

    /// The facets of a solid, in their place.
    fn facets(
        &mut self,
        kind: SolidWord,
        word: &'static Word,
        call: &Call<'_>,
        context: &Context,
    ) -> Result<Piece, Lost> {
        let origin = Origin::of(word, call);
        let arguments = BoundArguments::bind(call, word, &mut self.sink)?;
        let fragments = arguments.fragments(context.fragments);
        let (shape, local) = self.shape(kind, &arguments, None, call)?;
        if let Shape::Bezier(_) = shape {
            return Err(self.not_yet("what holds it is made of facets, which patches have none of", origin));
        }
        let mesh = self.facets_of(&shape, &local, fragments, origin)?;
        let primitive = Primitive::new(Shape::Mesh(mesh), local, MaterialId(0)).with_map_error(DVec3::ZERO);
        self.placed_piece(Piece::Solid(Solid::Primitive(primitive)), context, origin)
    }

    /// The facets of a unit shape that this map gives its size.
    pub(super) fn facets_of(
        &mut self,
        shape: &Shape,
        local: &DAffine3,
        fragments: Fragments,
        origin: Origin,
    ) -> Result<Arc<Mesh>, Lost> {
        let largest = local.matrix3.x_axis.abs().max(local.matrix3.y_axis.abs()).max_element();
        let Some(mesh) = faceted(shape, largest, &fragments) else { return Err(self.too_many(origin)) };
        self.check_corners(mesh.points.len() as f64, origin)?;
        Ok(mesh)
    }

    /// A piece, in its place among those of what it is a part of.
    pub(super) fn placed_piece(
        &mut self,
        piece: Piece,
        context: &Context,
        origin: Origin,
    ) -> Result<Piece, Lost> {
        let maps = &context.maps;
        let map = *maps.product();
        let placed = match piece {
            Piece::Figure(figure) => {
                let error = maps.error(&figure.bounds()).truncate().length();
                let placed = figure.mapped(&map);
                placed.map(|figure| Piece::Figure(Figure { error: figure.error + error, ..figure }))
            }
            Piece::Solid(solid) => Some(Piece::Solid(rebuilt(&solid, |primitive| {
                let bounds = primitive.shape.bounds().mapped(&primitive.map);
                moved(primitive, &map, maps.error(&bounds))
            }))),
        };
        placed.ok_or_else(|| {
            let message =
                format!("`{}` is made flat by what stands above it, and left out", origin.word.name);
            self.sink.note(Diagnostic::note(origin.name, message));
            Lost::Empty
        })
    }

    /// A piece as a solid of the scene.
    pub(super) fn shown(&mut self, piece: Piece, context: &Context, origin: Origin) -> Result<Solid, Lost> {
        match piece {
            Piece::Figure(figure) => {
                if figure.regions.is_empty() {
                    return Err(Lost::Empty);
                }
                let (bottom, top) = context.space.thickness();
                let Some(mesh) = prism(&figure, bottom, top, &mut self.clipper) else {
                    return Err(self.too_many(origin));
                };
                let off = DVec3::new(figure.error, figure.error, 0.0);
                let shape = Shape::Mesh(Arc::new(mesh));
                let primitive = self.put(shape, DAffine3::IDENTITY, off, context, origin)?;
                self.note_digits(&primitive, &DAffine3::IDENTITY, context);
                Ok(Solid::Primitive(primitive))
            }
            Piece::Solid(_) if matches!(context.space, FormSpace::Extruded { .. }) => {
                Err(self.solid_in_drawing(origin))
            }
            Piece::Solid(solid) => {
                let mut lost = None;
                let solid = rebuilt(&solid, |primitive| {
                    let (shape, map, off) = (primitive.shape.clone(), primitive.map, primitive.map_error());
                    self.put(shape, map, off, context, origin).unwrap_or_else(|why| {
                        lost = Some(why);
                        primitive.clone()
                    })
                });
                match lost {
                    Some(lost) => Err(lost),
                    None if matches!(&solid, Solid::Union(parts) if parts.is_empty()) => Err(Lost::Empty),
                    None => Ok(solid),
                }
            }
        }
    }
}

fn flat_points(
    list: &Spanned<'_>,
    arguments: &BoundArguments<'_, '_>,
    sink: &mut Sink,
) -> Result<Vec<DVec2>, Lost> {
    let refuse = |value: &Spanned<'_>, message: &str, sink: &mut Sink| {
        let error = Diagnostic::error(value.span, message);
        arguments.refuse(error.label(format!("this is {}", value.value.describe())), Lost::Missing, sink)
    };
    let Value::List(items) = &list.value else {
        return Err(refuse(list, "`points` of `polygon` takes a list of points [x, y]", sink));
    };
    let mut points = Vec::with_capacity(items.len());
    for item in items {
        match numbers(&item.value).as_deref() {
            Some(&[x, y] | &[x, y, _]) if x.is_finite() && y.is_finite() => points.push(DVec2::new(x, y)),
            Some([_, _] | [_, _, _]) => return Err(refuse(item, "a point of `polygon` is no place", sink)),
            _ => return Err(refuse(item, "a point of `polygon` is [x, y]", sink)),
        }
    }
    Ok(points)
}

/// The outlines that name points.
fn chosen(
    paths: &Spanned<'_>,
    points: &[DVec2],
    arguments: &BoundArguments<'_, '_>,
    sink: &mut Sink,
) -> Result<Vec<Vec<DVec2>>, Lost> {
    let refuse = |value: &Spanned<'_>, message: String, sink: &mut Sink| {
        let error = Diagnostic::error(value.span, message);
        arguments.refuse(error.label(format!("this is {}", value.value.describe())), Lost::Missing, sink)
    };
    let Value::List(items) = &paths.value else {
        return Err(refuse(paths, "`paths` of `polygon` takes a list of indices, or of lists".into(), sink));
    };
    let is_one = items.iter().all(|item| matches!(item.value, Value::Number(_))) && !items.is_empty();
    let lists = if is_one { std::slice::from_ref(paths) } else { items.as_slice() };
    let mut outlines = Vec::with_capacity(lists.len());
    for list in lists {
        let Value::List(indices) = &list.value else {
            return Err(refuse(list, "a path of `polygon` is a list of indices".into(), sink));
        };
        let mut outline = Vec::with_capacity(indices.len());
        for index in indices {
            let point = match index.value {
                Value::Number(number) if number >= 0.0 && number.fract() == 0.0 => {
                    points.get(number as usize)
                }
                _ => None,
            };
            let Some(&point) = point else {
                let message =
                    format!("a path of `polygon` names one of its {} points by an index", points.len());
                return Err(refuse(index, message, sink));
            };
            outline.push(point);
        }
        outlines.push(outline);
    }
    Ok(outlines)
}
