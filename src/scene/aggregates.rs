//! The conservative pressure matrix summed up over aggregates of points, for the coarse pressure; on the host, once.
//!
//! An aggregate of the finest level is what hangs together within a square two of the points' own spacings wide, to a power of two; of
//! the next level, within four such squares; and at last, whatever hangs together. `K_0 = R K R^T` with `R` the sum over an aggregate,
//! `K_(l+1) = R K_l R^T / SCALE` (see [`crate::cpu::operations::coarse`]). A row is kept as its links and what holds it, both at
//! least 0, so that no rounding error stands where a diagonal is 0.
//! Source: Braess, Computing 55 (1995) 379-393.

use super::Scene;
use crate::cpu::operations::coarse::{DAMPING, SCALE};
use crate::engine::Data;
use crate::step::aggregates::Level;
use crate::step::{BLOCK, Buffer};

/// Width of the finest squares, in spacings.
const WIDTH: f64 = 2.0;
/// Where a square begins, over its width: not on the points of a lattice.
const BEGIN: f64 = 0.25;
/// Not numbered yet.
const NONE: u32 = u32::MAX;

/// The levels, and their arrays.
#[derive(Debug, Clone)]
pub struct Aggregates {
    pub levels: Vec<Level>,
    /// Place of each point's aggregate; 0 where the pressure is held.
    cell: Vec<u32>,
    /// Where the parts of every place begin, and one more; the parts; the aggregate that each place is part of.
    start: Vec<u32>,
    parts: Vec<u32>,
    parent: Vec<u32>,
    /// Of every entry: a neighbour's place, and the link to it, no unit.
    neighbours: Vec<u32>,
    links: Vec<f64>,
    /// Diagonal of every place.
    diagonal: Vec<f64>,
}

/// Nodes and the links between them: `(K p)_i = held_i p_i + sum_j w_ij (p_i - p_j)`.
struct Graph {
    start: Vec<usize>,
    other: Vec<u32>,
    weight: Vec<f64>,
    held: Vec<f64>,
}

/// Which group each node is of, and the nodes of each.
struct Groups {
    of: Vec<u32>,
    count: usize,
    /// Where the members of each begin, and one more.
    start: Vec<u32>,
    members: Vec<u32>,
}

impl Graph {
    fn empty() -> Self {
        Self { start: vec![0], other: Vec::new(), weight: Vec::new(), held: Vec::new() }
    }

    /// That of the points whose pressure is not held, and which those are.
    fn of_points(scene: &Scene) -> Option<(Self, Vec<u32>)> {
        let (cells, points) = (scene.cells()?, scene.sizes.points);
        let free: Vec<u32> = (0..points as u32).filter(|&point| !scene.is_outlet(point as usize)).collect();
        let mut node = vec![NONE; points];
        (0..).zip(&free).for_each(|(number, &point)| node[point as usize] = number);
        let mut graph = Self::empty();
        for &point in &free {
            let mut held = 0.0;
            for (other, weight) in cells.faces(point as usize) {
                if node[other] == NONE {
                    held += weight;
                } else {
                    graph.other.push(node[other]);
                    graph.weight.push(weight);
                }
            }
            graph.held.push(held);
            graph.start.push(graph.other.len());
        }
        Some((graph, free))
    }

    fn len(&self) -> usize {
        self.held.len()
    }

    fn links(&self, node: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        (self.start[node]..self.start[node + 1]).map(|link| (self.other[link] as usize, self.weight[link]))
    }

    fn most_links(&self) -> usize {
        self.start.windows(2).map(|pair| pair[1] - pair[0]).max().unwrap_or(0)
    }

    /// What hangs together by links between nodes that are `alike`.
    fn groups(&self, alike: &dyn Fn(usize, usize) -> bool) -> Groups {
        let mut of = vec![NONE; self.len()];
        let (mut count, mut waiting) = (0, Vec::new());
        for first in 0..self.len() {
            if of[first] != NONE {
                continue;
            }
            of[first] = count;
            waiting.push(first);
            while let Some(node) = waiting.pop() {
                for (other, weight) in self.links(node) {
                    if weight > 0.0 && of[other] == NONE && alike(node, other) {
                        of[other] = count;
                        waiting.push(other);
                    }
                }
            }
            count += 1;
        }
        Groups::new(of, count as usize)
    }

    /// The links between groups, over `scale`.
    fn summed(&self, groups: &Groups, scale: f64) -> Graph {
        let mut sum = Self::empty();
        let mut slot = vec![usize::MAX; groups.count];
        for group in 0..groups.count {
            let first = sum.other.len();
            let mut held = 0.0;
            for &member in groups.members(group) {
                held += self.held[member as usize];
                for (other, weight) in self.links(member as usize) {
                    let other = groups.of[other] as usize;
                    if other == group {
                        continue;
                    }
                    if !(first..sum.other.len()).contains(&slot[other]) {
                        slot[other] = sum.other.len();
                        sum.other.push(other as u32);
                        sum.weight.push(0.0);
                    }
                    sum.weight[slot[other]] += weight;
                }
            }
            sum.weight[first..].iter_mut().for_each(|weight| *weight /= scale);
            sum.held.push(held / scale);
            sum.start.push(sum.other.len());
        }
        sum
    }
}

impl Groups {
    fn new(of: Vec<u32>, count: usize) -> Self {
        let mut start = vec![0; count + 1];
        of.iter().for_each(|&group| start[group as usize + 1] += 1);
        for group in 0..count {
            start[group + 1] += start[group];
        }
        let (mut next, mut members) = (start.clone(), vec![0; of.len()]);
        for (node, &group) in (0..).zip(&of) {
            members[next[group as usize] as usize] = node;
            next[group as usize] += 1;
        }
        Self { of, count, start, members }
    }

    fn members(&self, group: usize) -> &[u32] {
        &self.members[self.start[group] as usize..self.start[group + 1] as usize]
    }
}

/// A square: its width as a power of two, its column and its row.
#[derive(Clone, Copy, PartialEq, Eq, Default)]
struct Square([i64; 3]);

impl Square {
    fn of(scene: &Scene, point: usize) -> Self {
        let (cloud, place) = (&scene.cloud, scene.cloud.position[point]);
        let size = (cloud.spacing_at(point) / cloud.spacing).log2().round();
        let width = WIDTH * cloud.spacing * size.exp2();
        // A jittered point may stand before the seam of a domain that repeats.
        let along = |place: f64| (place / width + BEGIN).floor().max(0.0) as i64;
        Self([size as i64, along(place.x), along(place.y)])
    }

    /// The one of four that it is one of.
    fn above(self) -> Self {
        let [size, column, row] = self.0;
        Self([size + 1, column.div_euclid(2), row.div_euclid(2)])
    }
}

impl Aggregates {
    /// Those of the scene's conservative matrix.
    pub(super) fn build(scene: &Scene) -> Option<Self> {
        let (mut graph, free) = Graph::of_points(scene)?;
        let mut square: Vec<Square> = free.iter().map(|&point| Square::of(scene, point as usize)).collect();
        // Points, then places.
        let mut name = free;
        let mut all = Self {
            levels: Vec::new(),
            cell: vec![0; scene.sizes.points],
            start: vec![0; BLOCK],
            parts: Vec::new(),
            parent: vec![0; BLOCK],
            neighbours: Vec::new(),
            links: Vec::new(),
            diagonal: vec![0.0; BLOCK],
        };
        loop {
            let finest = all.levels.is_empty();
            let mut groups = graph.groups(&|one, other| square[one] == square[other]);
            if !finest && groups.count == graph.len() {
                // Squares of several widths are left.
                groups = graph.groups(&|_, _| true);
                if groups.count == graph.len() {
                    break;
                }
            }
            graph = graph.summed(&groups, if finest { 1.0 } else { SCALE });
            let slots = graph.most_links();
            let level = match all.levels.last() {
                Some(level) => level.above(groups.count, slots),
                None => Level::finest(groups.count, slots),
            };
            let mut above = vec![Square::default(); groups.count];
            for (node, &group) in groups.of.iter().enumerate() {
                let whole = if finest { &mut all.cell } else { &mut all.parent };
                whole[name[node] as usize] = level.first as u32 + group;
                above[group as usize] = square[node].above();
            }
            all.add(level, &graph, &groups, &name);
            square = above;
            name = (0..groups.count).map(|group| (level.first + group) as u32).collect();
        }
        all.start.push(all.parts.len() as u32);
        Some(all)
    }

    /// The parts and rows of one more level.
    fn add(&mut self, level: Level, graph: &Graph, groups: &Groups, name: &[u32]) {
        let (width, end) = (level.width(), level.first + level.width());
        let before = self.parts.len() as u32;
        self.start.extend(groups.start[..level.count].iter().map(|start| before + start));
        self.parts.extend(groups.members.iter().map(|&member| name[member as usize]));
        self.start.resize(end, self.parts.len() as u32);
        self.parent.resize(end, 0);
        let unused = |place: usize| if place < level.count { (level.first + place) as u32 } else { 0 };
        self.neighbours.extend((0..level.slots).flat_map(|_| (0..width).map(unused)));
        self.links.resize(self.neighbours.len(), 0.0);
        for node in 0..graph.len() {
            let place = level.first + node;
            for (slot, (other, weight)) in graph.links(node).enumerate() {
                self.neighbours[level.entry(place, slot)] = (level.first + other) as u32;
                self.links[level.entry(place, slot)] = weight;
            }
            self.diagonal.push(graph.held[node] + graph.links(node).map(|(_, weight)| weight).sum::<f64>());
        }
        self.diagonal.resize(end, 0.0);
        self.levels.push(level);
    }

    /// Places of all levels together, their parts, and entries of their rows.
    pub fn sizes(&self) -> [usize; 3] {
        [self.diagonal.len(), self.parts.len(), self.links.len()]
    }

    /// The arrays of the engines.
    pub(super) fn arrays(&self, padded: usize) -> Vec<(Buffer, Data)> {
        let mut cell = self.cell.clone();
        cell.resize(padded, 0);
        let smoothing = self.diagonal.iter().map(|&own| if own > 0.0 { DAMPING / own } else { 0.0 });
        let matrix = self.diagonal.iter().copied().chain(smoothing).chain(self.links.iter().copied()).collect();
        vec![
            (Buffer::CoarseCell, Data::Index(cell)),
            (Buffer::AggregateStart, Data::Index(self.start.clone())),
            (Buffer::AggregateParts, Data::Index(self.parts.clone())),
            (Buffer::AggregateParent, Data::Index(self.parent.clone())),
            (Buffer::AggregateNeighbours, Data::Index(self.neighbours.clone())),
            (Buffer::AggregateMatrix, Data::Real(matrix)),
        ]
    }
}
