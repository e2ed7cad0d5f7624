//! Blocks in the making: copyable handles, and the nodes that operators on them make.

mod operations;

use super::block::{Block, Fact, Node, NodeId, Op, Probe, Rate, Section};
use super::names;
use super::place::{Place, Step};
use crate::device::MULTIPLIER_BITS;
use crate::op::*;
use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

/// The blocks of a design in the making.
pub struct Library {
    /// Bits of the signed operands of a hardware multiplier, the wider first.
    multiplier: [u32; 2],
    /// What names of blocks begin with, so that those of two libraries can stand side by side.
    prefix: &'static str,
    drafts: RefCell<Vec<Draft>>,
    finished: RefCell<HashMap<String, Rc<Block>>>,
}

/// A block in the making.
struct Draft {
    block: Block,
    /// Ranges of every node: one, or one per column.
    ranges: Vec<Vec<Range>>,
    /// Cases in which per-phase values have ranges of their own: the phases of the block at the top.
    columns: usize,
    /// Values that are connected later, with what they are connected to.
    later: HashMap<usize, Option<NodeId>>,
    /// The section in which nodes are made.
    section: Option<usize>,
}

impl Draft {
    /// Removes what no output depends on.
    fn prune(&mut self) {
        let mut used = vec![false; self.block.nodes.len()];
        let inputs = self.block.inputs.iter().copied();
        let mut open: Vec<NodeId> = inputs.chain(self.block.outputs.iter().map(|o| o.1)).collect();
        while let Some(id) = open.pop() {
            if !std::mem::replace(&mut used[id.0], true) {
                open.extend(&self.block.nodes[id.0].args);
                // All outputs of an instance stay, so that every port is connected.
                if matches!(self.block.nodes[id.0].op, Op::Instance(_)) {
                    let outputs = (0..used.len()).filter(|i| self.block.nodes[*i].args.first() == Some(&id));
                    open.extend(outputs.map(NodeId));
                }
            }
        }
        let mut count = 0;
        let mut place = |used: &bool| {
            count += usize::from(*used);
            NodeId(count.wrapping_sub(1))
        };
        let places: Vec<NodeId> = used.iter().map(&mut place).collect();
        let mut kept = used.iter();
        self.block.nodes.retain(|_| *kept.next().expect("one flag per node"));
        let mut kept = used.iter();
        self.ranges.retain(|_| *kept.next().expect("one flag per node"));
        let moved = |id: &mut NodeId| *id = places[id.0];
        self.block.nodes.iter_mut().flat_map(|n| &mut n.args).for_each(moved);
        self.block.inputs.iter_mut().for_each(moved);
        self.block.outputs.iter_mut().for_each(|o| moved(&mut o.1));
        self.block.probes.retain(|p| used[p.node.0]);
        self.block.probes.iter_mut().for_each(|p| moved(&mut p.node));
    }
}

/// A signal: a handle of a node in a block in the making.
#[derive(Clone, Copy)]
pub struct Sig<'l> {
    library: &'l Library,
    block: usize,
    id: NodeId,
}

impl PartialEq for Sig<'_> {
    fn eq(&self, other: &Self) -> bool {
        (self.block, self.id) == (other.block, other.id)
    }
}

impl Eq for Sig<'_> {}

impl std::fmt::Debug for Sig<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.describe())
    }
}

impl Default for Library {
    fn default() -> Self {
        Self { multiplier: [MULTIPLIER_BITS; 2], prefix: "", drafts: RefCell::default(), finished: RefCell::default() }
    }
}

impl Library {
    /// A library in which the name of every block begins with a prefix.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let library = Library::with_prefix("mine_");
    /// let block = library.block("copy", &[], 1, |top| top.input(NUMBER, (0, 9)).named("x"));
    /// assert_eq!(block.name, "mine_copy");
    /// ```
    pub fn with_prefix(prefix: &'static str) -> Self {
        Self { prefix, ..Self::default() }
    }

    /// The same for a part whose multipliers take signed operands of so many bits, the wider first.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let library = Library::default().with_multiplier([25, 18]);
    /// library.block("copy", &[], 1, |top| {
    ///     assert_eq!(top.multiplier(), [25, 18]);
    ///     top.input(NUMBER, (0, 9)).named("x")
    /// });
    /// ```
    // For the pipelines of the unit.
    #[doc(hidden)]
    pub fn with_multiplier(self, multiplier: [u32; 2]) -> Self {
        Self { multiplier, ..self }
    }

    /// Begins a block with `interval` phases. `columns` are the cases in which per-phase values are looked at.
    pub(super) fn begin(&self, name: &str, doc: &[&str], interval: usize, columns: usize) -> usize {
        let doc = doc.iter().map(|line| (*line).to_owned()).collect();
        let block = Block::new(format!("{}{name}", self.prefix), doc, interval);
        let mut drafts = self.drafts.borrow_mut();
        drafts.push(Draft { block, ranges: vec![], columns, later: HashMap::new(), section: None });
        drafts.len() - 1
    }

    /// The finished block; one of that name that is the same but for ranges is taken instead.
    pub(super) fn finish(&self, block: usize, outputs: &[Sig<'_>]) -> Rc<Block> {
        let mut draft = {
            let mut drafts = self.drafts.borrow_mut();
            assert_eq!(block + 1, drafts.len(), "blocks are finished from the inside outward");
            drafts.pop().expect("the block was begun")
        };
        for (node, to) in std::mem::take(&mut draft.later) {
            let to =
                to.unwrap_or_else(|| panic!("block {}: a value that comes later is not connected", draft.block.name));
            draft.block.nodes.iter_mut().flat_map(|n| &mut n.args).filter(|a| a.0 == node).for_each(|a| *a = to);
        }
        draft.block.outputs = outputs.iter().map(|o| (Place::default(), o.id)).collect();
        draft.prune();
        names::derive(&mut draft.block);
        let ranges: Vec<Range> = draft.ranges.into_iter().map(hull).collect();
        let (mut finished, block) = (self.finished.borrow_mut(), draft.block);
        let known = finished.get(&block.name).cloned();
        assert!(
            known.as_ref().is_none_or(|known| known.same(&block)),
            "two different blocks are called {}",
            block.name
        );
        let block = known.unwrap_or_else(|| {
            let (name, block) = (block.name.clone(), Rc::new(block));
            finished.insert(name, Rc::clone(&block));
            block
        });
        block.widen(&ranges);
        block
    }
}

/// The block at the top in the making: what makes its inputs.
#[derive(Clone, Copy)]
pub struct Top<'l> {
    library: &'l Library,
    block: usize,
}

impl<'l> Top<'l> {
    pub(super) fn of(library: &'l Library, block: usize) -> Self {
        Self { library, block }
    }

    /// An input that is held for the pair.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let library = Library::default();
    /// let block = library.block("twice", &["y = 2 x"], 1, |top| {
    ///     let x = top.input(NUMBER, (0, 9)).named("x");
    ///     (x + x).named("y")
    /// });
    /// assert_eq!(block.range(block.outputs[block.output("y")].1.0), (0, 18));
    /// ```
    pub fn input(self, ty: Type, range: Range) -> Sig<'l> {
        self.port(ty, vec![range], Rate::Pair)
    }

    /// An input that does not change while anything is in flight: it is there in every clock, and no register holds it.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let library = Library::default();
    /// library.block("sum", &[], 4, |top| {
    ///     let x = top.steady(NUMBER, (0, 9)).named("x");
    ///     assert_eq!(x.rate(), Rate::Any);
    ///     (x + top.input(NUMBER, (0, 9)).named("y")).named("z")
    /// });
    /// ```
    pub fn steady(self, ty: Type, range: Range) -> Sig<'l> {
        let input = self.port(ty, vec![range], Rate::Any);
        self.library.with(self.block, |draft| draft.block.nodes[input.id.0].op = Op::Steady);
        input
    }

    /// An input with ranges of its own in every case, or the same in all.
    pub(crate) fn port(self, ty: Type, ranges: Vec<Range>, rate: Rate) -> Sig<'l> {
        let sig = self.library.push(self.block, Op::Input, vec![], ty, rate, ranges);
        self.library.with(self.block, |draft| draft.block.inputs.push(sig.id));
        sig
    }

    /// A section of the block: what is made in it is an entity of its own, of that name. Clocks are those of the block.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let library = Library::default();
    /// let block = library.block("double_square", &[], 1, |top| {
    ///     let x = top.input(NUMBER, (-9, 9)).named("x");
    ///     let square = top.section("square", &["x x"], || (x * x).named("xx"));
    ///     (square + square).named("y")
    /// });
    /// let device = device::find("xc2v6000-4")?;
    /// let (module, _) = Lowering::new(&mut Scheduler::new(device, 100), device).lower(&block, false);
    /// assert_eq!(module.instances[0].module.name, "square");
    /// # Ok::<(), device::DeviceError>(())
    /// ```
    pub fn section<R>(self, name: &str, doc: &[&str], make: impl FnOnce() -> R) -> R {
        let begun = self.library.with(self.block, |draft| {
            let doc = doc.iter().map(|line| (*line).to_owned()).collect();
            draft.block.sections.push(Section { name: format!("{}{name}", self.library.prefix), doc });
            draft.section.replace(draft.block.sections.len() - 1)
        });
        assert!(begun.is_none(), "section {name}: expected to begin outside of other sections");
        let made = make();
        self.library.with(self.block, |draft| draft.section = None);
        made
    }

    /// Number of phases.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(evaluated(3, &[5], |x| x[0].like(x[0].block().interval() as i128) + x[0]), [8; 3]);
    /// ```
    pub fn interval(self) -> usize {
        self.library.with(self.block, |draft| draft.block.interval)
    }

    /// Bits of the signed operands of a hardware multiplier, the wider first: [18, 18](MULTIPLIER_BITS) if the
    /// [library](Library::with_multiplier) was not told.
    // For what makes products of parts.
    #[doc(hidden)]
    pub fn multiplier(self) -> [u32; 2] {
        self.library.multiplier
    }

    /// A constant.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(value(&[5], |x| x[0].block().constant(7, NUMBER) - x[0]), 2);
    /// ```
    pub fn constant(self, value: i128, ty: Type) -> Sig<'l> {
        let op = Op::Comb(Constant(value, ty).into());
        self.library.shared(self.block, op, ty, Rate::Any, vec![(value, value)])
    }

    /// A constant of its own: an element of a bundle.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(value(&[5], |x| {
    ///     let both = [1, 2].map(|i| x[0].block().element(i, NUMBER)).named("both");
    ///     both[1] * x[0]
    /// }), 10);
    /// ```
    pub fn element(self, value: i128, ty: Type) -> Sig<'l> {
        let op = Op::Comb(Constant(value, ty).into());
        self.library.push(self.block, op, vec![], ty, Rate::Any, vec![(value, value)])
    }

    /// A constant of each phase; none where it does not matter.
    pub(super) fn pattern(self, values: Vec<Option<i128>>, ty: Type) -> Sig<'l> {
        let first = values.iter().flatten().next().copied().unwrap_or(0);
        // In a multiplexer of one operand the pattern says in which phases that is read.
        if values.iter().all(|v| v.is_some_and(|v| v == first)) {
            return self.constant(first, ty);
        }
        let ranges = values.iter().map(|v| v.unwrap_or(0)).map(|v| (v, v)).collect();
        self.library.shared(self.block, Op::Phase(values), ty, Rate::Phase, ranges)
    }

    /// A value that is connected later; its type and range are promised.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// // The last phase reads what the first has made.
    /// let values = evaluated(2, &[5], |x| {
    ///     let first = x[0].block().later(NUMBER, (0, 900));
    ///     let phases = Phases::new(2, |s| Some([x[0], first][s])).late(|signal| *signal == first);
    ///     let next = (phases.mux().named("operand") + x[0].like(2)).named("next");
    ///     first.connect(next.capture(0, false).within((0, 900), "x is positive").bits(16).named("first"));
    ///     next
    /// });
    /// assert_eq!(values, [7, 9]);
    /// ```
    pub fn later(self, ty: Type, range: Range) -> Sig<'l> {
        let sig = self.library.push(self.block, Op::Input, vec![], ty, Rate::Pair, vec![range]);
        self.library.with(self.block, |draft| draft.later.insert(sig.id.0, None));
        sig
    }
}

impl Library {
    fn with<R>(&self, block: usize, f: impl FnOnce(&mut Draft) -> R) -> R {
        f(&mut self.drafts.borrow_mut()[block])
    }

    fn push(&self, block: usize, op: Op, args: Vec<NodeId>, ty: Type, rate: Rate, ranges: Vec<Range>) -> Sig<'_> {
        let id = self.with(block, |draft| {
            let (place, comment) = (Place::default(), String::new());
            let section = draft.section;
            draft.block.nodes.push(Node { op, args, ty, rate, place, named: false, comment, section });
            draft.ranges.push(ranges);
            NodeId(draft.block.nodes.len() - 1)
        });
        let sig = Sig { library: self, block, id };
        let (ty, ranges) = (sig.ty(), sig.ranges());
        for (column, range) in ranges.iter().enumerate() {
            if !ty.holds(*range) {
                let case = if ranges.len() > 1 { format!(" in phase {column}") } else { String::new() };
                sig.refuse(&format!("values from {} to {}{case} do not fit {ty}", range.0, range.1));
            }
        }
        sig
    }

    /// A node without operands, made once.
    fn shared(&self, block: usize, op: Op, ty: Type, rate: Rate, ranges: Vec<Range>) -> Sig<'_> {
        let known =
            self.with(block, |draft| draft.block.nodes.iter().position(|n| n.op == op && n.ty == ty && !n.named));
        match known {
            Some(id) => Sig { library: self, block, id: NodeId(id) },
            None => self.push(block, op, vec![], ty, rate, ranges),
        }
    }
}

impl<'l> Sig<'l> {
    /// The block it is in.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(value(&[5], |x| x[0] + x[0].block().constant(1, NUMBER)), 6);
    /// ```
    pub fn block(self) -> Top<'l> {
        Top { library: self.library, block: self.block }
    }

    pub(super) fn library(self) -> &'l Library {
        self.library
    }

    pub(super) fn columns(self) -> usize {
        self.library.with(self.block, |draft| draft.columns)
    }

    fn node<R>(self, f: impl FnOnce(&mut Node) -> R) -> R {
        self.library.with(self.block, |draft| f(&mut draft.block.nodes[self.id.0]))
    }

    /// Its type.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// value(&[5], |x| {
    ///     assert_eq!((x[0] * x[0]).ty(), Type::signed(32, 0));
    ///     x[0]
    /// });
    /// ```
    pub fn ty(self) -> Type {
        self.node(|n| n.ty)
    }

    /// How often it changes.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// evaluated(2, &[5, 6], |x| {
    ///     assert_eq!(x[0].rate(), Rate::Pair);
    ///     let shared = Phases::new(2, |s| Some(x[s])).mux();
    ///     assert_eq!(shared.rate(), Rate::Phase);
    ///     shared
    /// });
    /// ```
    pub fn rate(self) -> Rate {
        self.node(|n| n.rate)
    }

    /// Its fraction bits.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// value(&[5], |x| {
    ///     assert_eq!(x[0].floor(3).fraction(), -3);
    ///     x[0]
    /// });
    /// ```
    pub fn fraction(self) -> i32 {
        self.ty().fraction.unwrap_or(0)
    }

    /// Its ranges: one, or one per phase.
    pub(super) fn ranges(self) -> Vec<Range> {
        self.library.with(self.block, |draft| draft.ranges[self.id.0].clone())
    }

    /// The range of all its values.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// value(&[5], |x| {
    ///     assert_eq!((x[0] - x[0].like(5)).range(), (-1005, 995));
    ///     x[0]
    /// });
    /// ```
    pub fn range(self) -> Range {
        hull(self.ranges())
    }

    /// Its name, or what it is made of.
    fn describe(self) -> String {
        let (op, args, place) = self.node(|n| (n.op.clone(), n.args.clone(), n.place.clone()));
        if !place.is_empty() {
            return place.to_string();
        }
        let args: Vec<String> = args.iter().map(|id| Sig { id: *id, ..self }.describe()).collect();
        match op {
            Op::Comb(op) => format!("{}({})", op.role(), args.join(", ")),
            Op::Output(_) => args.concat(),
            Op::Instance(block) => block.name.clone(),
            other => format!("{other:?}({})", args.join(", ")),
        }
    }

    /// Refuses what cannot be: a defect of the caller.
    fn refuse(self, why: &str) -> ! {
        let block = self.library.with(self.block, |draft| draft.block.name.clone());
        panic!("block {block}, {}: {why}", self.describe())
    }

    /// An operation on this signal and others.
    ///
    /// # Panics
    /// If the operands do not fit the operation, or values its type.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(value(&[3, 4], |x| x[0].apply(Add::default(), &[x[1]])), 7);
    /// ```
    pub fn apply(self, op: impl Into<Comb>, others: &[Self]) -> Self {
        let op = op.into();
        let args = joined(&[&[self], others].concat());
        let types: Vec<Type> = args.iter().map(|a| a.ty()).collect();
        let ty = op.result(&types).unwrap_or_else(|why| {
            let operands: Vec<String> = args.iter().map(|a| a.describe()).collect();
            self.refuse(&format!("{} of {}: {why}", op.role(), operands.join(" and ")))
        });
        let ranges = columns(&args, |ranges| op.range(ranges, &types, ty));
        // Two numbers as operands would leave VHDL without a type to find the operator by.
        let constant = |arg: &Self| {
            let mut arg = *arg;
            while let Some(same) = arg.node(|n| matches!(n.op, Op::Point).then(|| n.args[0])) {
                arg.id = same;
            }
            arg.node(|n| match &n.op {
                Op::Comb(Comb::Constant(Constant(value, _))) => Some(*value),
                _ => None,
            })
        };
        if let Some(values) = args.iter().map(constant).collect::<Option<Vec<i128>>>() {
            return self.block().element(op.value(&values, &types, ty), ty);
        }
        self.make(Op::Comb(op), &args, ty, ranges)
    }

    /// A node that reads `args`.
    fn make(self, op: Op, args: &[Self], ty: Type, ranges: Vec<Range>) -> Self {
        let rate = args.iter().map(|a| a.rate()).fold(Rate::Any, |a, b| if a == Rate::Any { b } else { a });
        self.library.push(self.block, op, args.iter().map(|a| a.id).collect(), ty, rate, ranges)
    }

    /// The same per-pair value in every phase.
    fn broadcast(self) -> Self {
        let select = self.block().constant(0, Type::FLAG);
        let known = self.library.with(self.block, |draft| {
            let op = Op::Mux { late: vec![false] };
            draft.block.nodes.iter().position(|n| n.op == op && n.args == [select.id, self.id])
        });
        match known {
            Some(id) => Self { id: NodeId(id), ..self },
            None => self.mux(select, &[(self, false)], self.ranges()),
        }
    }

    /// A multiplexer among operands, each with whether it is a late one.
    pub(super) fn mux(self, select: Self, operands: &[(Self, bool)], ranges: Vec<Range>) -> Self {
        let mut ty = operands[0].0.ty();
        for (operand, _) in operands {
            let other = operand.ty();
            if !other.same_bits(ty) {
                operand.refuse(&format!("expected {ty} as the other operands of the multiplexer, found {other}"));
            }
            ty.fraction = ty.fraction.filter(|_| ty.fraction == other.fraction);
        }
        let late = operands.iter().map(|o| o.1).collect();
        let args = std::iter::once(select.id).chain(operands.iter().map(|o| o.0.id)).collect();
        self.library.push(self.block, Op::Mux { late }, args, ty, Rate::Phase, ranges)
    }

    /// Running disjunction over phases, anew where `first` is set.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let so_far = evaluated(4, &[1, 2, 4, 8], |x| {
    ///     let flags = Phases::new(4, |s| Some(x[s])).mux().low(4).at_point(None);
    ///     let first = Phases::new(4, |s| Some(i128::from(s == 0 || s == 2))).constant(x[0].block(), Type::FLAG);
    ///     flags.or_over_phases(first)
    /// });
    /// assert_eq!(so_far, [1, 3, 4, 12]);
    /// ```
    pub fn or_over_phases(self, first: Self) -> Self {
        if first.range() == (1, 1) {
            return self;
        }
        let (mine, first_ranges) = (self.ranges(), first.ranges());
        let (mut ranges, mut so_far) = (vec![], (0, 0));
        for column in 0..self.columns() {
            let fresh = mine[column % mine.len()];
            let starts = column == 0 || first_ranges[column % first_ranges.len()] == (1, 1);
            so_far = if starts { fresh } else { Or.range(&[fresh, so_far], &[], self.ty()) };
            ranges.push(so_far);
        }
        self.library.push(self.block, Op::ScanOr, vec![self.id, first.id], self.ty(), Rate::Phase, ranges)
    }

    /// Connects a value made by [`Top::later`].
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// // What is made at the end, read where it is not there yet.
    /// assert_eq!(value(&[5], |x| {
    ///     let later = x[0].block().later(NUMBER, (-1000, 1000));
    ///     let y = later + x[0];
    ///     later.connect(x[0]);
    ///     y
    /// }), 10);
    /// ```
    pub fn connect(self, value: Self) {
        let (promised, found) = (self.range(), value.range());
        if !self.ty().same_bits(value.ty()) || found.0 < promised.0 || promised.1 < found.1 {
            let expected = format!("{} within {promised:?}", self.ty());
            self.refuse(&format!("expected {expected}, found {} of {} within {found:?}", value.describe(), value.ty()));
        }
        self.library.with(self.block, |draft| draft.later.insert(self.id.0, Some(value.id)));
    }

    pub(super) fn set_name(self, base: &str, path: &[Step]) -> Self {
        self.node(|n| {
            n.place = Place::at(base, path);
            n.named = true;
        });
        self
    }

    /// Says what kind of value it is: where it has no name of its own, that ends the name of what reads it.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let library = Library::default();
    /// let block = library.block("sum", &[], 1, |top| {
    ///     let x = top.input(NUMBER, (0, 9)).named("x");
    ///     ((x + x).called("twice") * x).named("y")
    /// });
    /// assert!(block.nodes.iter().any(|node| node.name() == "y_twice"));
    /// ```
    pub fn called(self, role: &str) -> Self {
        self.node(|n| {
            if !n.named {
                n.place = Place::new(role);
            }
        });
        self
    }

    pub(super) fn set_comment(self, text: &str) -> Self {
        self.node(|n| n.comment = text.to_owned());
        self
    }

    pub(super) fn set_probe(self, phases: &[(usize, bool)]) -> Self {
        let probe = Probe { node: self.id, phases: phases.to_vec() };
        self.library.with(self.block, |draft| draft.block.probes.push(probe));
        self
    }

    pub(super) fn capture_signal(self, phase: usize, late: bool) -> Self {
        let ranges = self.ranges();
        let range = ranges[phase % ranges.len()];
        let op = Op::Capture { phase, late };
        self.library.push(self.block, op, vec![self.id], self.ty(), Rate::Pair, vec![range])
    }

    pub(super) fn assume_range(self, bound: Range, lemma: &'static str, phases: &[bool]) -> Self {
        let mut ranges = self.ranges();
        for (column, range) in ranges.iter_mut().enumerate() {
            if phases.get(column) != Some(&false) {
                *range = (range.0.max(bound.0), range.1.min(bound.1));
            }
        }
        self.make(Op::Assume(bound, lemma, phases.to_vec()), &[self], self.ty(), ranges)
    }

    /// The value, which is known to be in a range by the named lemma.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// value(&[5], |x| {
    ///     let y = (x[0] * x[0]).within((0, 1_000_000), "a square is not negative");
    ///     assert_eq!(y.range(), (0, 1_000_000));
    ///     y
    /// });
    /// ```
    pub fn within(self, range: Range, lemma: &'static str) -> Self {
        self.assume_range(range, lemma, &[])
    }

    /// The value this many phases before.
    pub(super) fn earlier_signal(self, phases: usize) -> Self {
        let ranges = self.ranges();
        let ranges = (0..ranges.len()).map(|s| ranges[s.saturating_sub(phases)]).collect();
        self.library.push(self.block, Op::Earlier(phases), vec![self.id], self.ty(), Rate::Phase, ranges)
    }

    /// The value, which is known to equal a function of others.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// value(&[5], |x| {
    ///     // Rounded up, and in the range of what is.
    ///     let up = (x[0].floor(1) + x[0].low(1).any()).known(Fact::Ceiling(1), &[x[0]]);
    ///     assert_eq!(up.range(), (-500, 500));
    ///     up
    /// });
    /// ```
    pub fn known(self, fact: Fact, of: &[Self]) -> Self {
        let args = [&[self], of].concat();
        let ranges = columns(&args, |r| fact.range(r));
        self.make(Op::Known(fact), &args, self.ty(), ranges)
    }

    /// The same bits with the binary point elsewhere, or without one.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(value(&[5, 6], |x| x[0].floor(1).at_point(Some(0)) + x[1]), 8);
    /// ```
    pub fn at_point(self, fraction: Option<i32>) -> Self {
        if self.ty().fraction == fraction {
            return self;
        }
        self.make(Op::Point, &[self], Type { fraction, ..self.ty() }, self.ranges())
    }

    pub(super) fn instance_of(self, block: &Rc<Block>, args: &[Self]) -> Self {
        self.make(Op::Instance(Rc::clone(block)), args, Type::FLAG, vec![(0, 0)])
    }

    pub(super) fn output_of(self, port: usize, ty: Type, rate: Rate, ranges: Vec<Range>) -> Self {
        let rate = if rate == Rate::Any { self.rate() } else { rate };
        self.library.push(self.block, Op::Output(port), vec![self.id], ty, rate, ranges)
    }
}

/// Operands of one node: per-pair values are brought into the phases where others are there already.
pub(super) fn joined<'l>(args: &[Sig<'l>]) -> Vec<Sig<'l>> {
    for other in &args[1..] {
        if other.block != args[0].block {
            args[0].refuse(&format!("{} is in another block", other.describe()));
        }
    }
    let phases = args.iter().any(|a| a.rate() == Rate::Phase);
    let bring = |a: &Sig<'l>| if phases && a.rate() == Rate::Pair { a.broadcast() } else { *a };
    args.iter().map(bring).collect()
}

/// A range for every column from those of the operands.
fn columns(args: &[Sig<'_>], f: impl Fn(&[Range]) -> Range) -> Vec<Range> {
    let all: Vec<Vec<Range>> = args.iter().map(|a| a.ranges()).collect();
    let count = all.iter().map(Vec::len).max().unwrap_or(1);
    (0..count).map(|c| f(&all.iter().map(|r| r[c % r.len()]).collect::<Vec<_>>())).collect()
}
