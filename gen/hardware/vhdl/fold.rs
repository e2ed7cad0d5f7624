//! Statements, and how those of a bundle's elements become one: an assignment of the whole, or a loop.

use super::shape::Shape;
use crate::expression::{Expression, Index, Name, Sub};

/// A statement.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Statement {
    /// `target <= value`.
    Assign(Name, Expression),
    /// Statements under a flag, and others where it is clear.
    If(Expression, Vec<Statement>, Vec<Statement>),
    /// An instance.
    Instance {
        /// Its label outside of loops.
        label: String,
        /// What it is an instance of.
        entity: String,
        /// Formal and actual, in the order of the ports.
        connections: Vec<(String, Expression)>,
    },
    /// Statements for every value of a loop variable.
    Loop {
        /// Which variable.
        depth: usize,
        /// Its first value.
        first: usize,
        /// Number of its values.
        size: usize,
        /// What is done.
        body: Vec<Statement>,
    },
}

impl Statement {
    /// The labels of instances.
    pub fn labels(&self) -> Vec<String> {
        match self {
            Self::Instance { label, .. } => vec![label.clone()],
            Self::Loop { body, .. } => body.iter().flat_map(Self::labels).collect(),
            _ => vec![],
        }
    }

    /// The same with every index replaced.
    fn with_indices(&self, f: &mut dyn FnMut(&Index) -> Index) -> Self {
        let all = |statements: &[Self], f: &mut dyn FnMut(&Index) -> Index| -> Vec<Self> {
            statements.iter().map(|statement| statement.with_indices(f)).collect()
        };
        match self {
            Self::Assign(target, value) => Self::Assign(target.with_indices(f), value.with_indices(f)),
            Self::If(flag, then, otherwise) => Self::If(flag.with_indices(f), all(then, f), all(otherwise, f)),
            Self::Instance { label, entity, connections } => {
                let connections = connections.iter().map(|(formal, value)| (formal.clone(), value.with_indices(f)));
                Self::Instance { label: label.clone(), entity: entity.clone(), connections: connections.collect() }
            }
            Self::Loop { depth, first, size, body } => {
                Self::Loop { depth: *depth, first: *first, size: *size, body: all(body, f) }
            }
        }
    }

    /// The flag that it is under.
    fn flag(&self) -> Option<&Expression> {
        match self {
            Self::If(flag, ..) => Some(flag),
            Self::Loop { body, .. } => body.first().and_then(Self::flag),
            _ => None,
        }
    }

    /// How many lines it takes, about.
    fn lines(&self) -> usize {
        match self {
            Self::Assign(..) | Self::Instance { .. } => 1,
            // What is under one flag stands there together.
            Self::If(_, then, otherwise) => then.iter().chain(otherwise).map(Self::lines).sum(),
            Self::Loop { body, .. } => 2 + body.iter().map(Self::lines).sum::<usize>(),
        }
    }
}

/// Shapes of the objects in reach, by name.
pub(super) trait Shapes {
    /// The shape of an object.
    fn shape(&self, base: &str) -> Option<&Shape>;

    /// The shape of a part.
    fn part(&self, name: &Name) -> Option<&Shape> {
        self.shape(&name.base)?.part(&name.subs)
    }
}

/// The statements of all parts of an object, folded; `leaf` gives that of a scalar part, if there is one.
pub(super) fn fold(
    shapes: &dyn Shapes,
    shape: &Shape,
    whole: &Name,
    depth: usize,
    leaf: &dyn Fn(&Name) -> Option<Statement>,
) -> Vec<Statement> {
    let part = |sub: Sub| {
        let mut name = whole.clone();
        name.subs.push(sub);
        name
    };
    match shape {
        Shape::Flag | Shape::Number(..) => leaf(whole).into_iter().collect(),
        Shape::Record(_, fields) => {
            let parts: Vec<(Sub, Vec<Statement>)> = fields
                .iter()
                .map(|(field, shape)| {
                    let sub = Sub::Field(field);
                    (sub.clone(), fold(shapes, shape, &part(sub), depth, leaf))
                })
                .collect();
            joined(shapes, whole, shape, &parts).unwrap_or_else(|| parts.into_iter().flat_map(|p| p.1).collect())
        }
        Shape::Array { vector, first, size, of } => {
            // Components are counted by the first variable, elements by the others.
            let (own, inner) = if *vector { (0, depth) } else { (1 + depth, depth + 1) };
            let parts: Vec<(Sub, Vec<Statement>)> = (*first..first + size)
                .map(|i| {
                    let sub = Sub::Index(Index::At(i));
                    (sub.clone(), fold(shapes, of, &part(sub), inner, leaf))
                })
                .collect();
            if let Some(one) = joined(shapes, whole, shape, &parts).or_else(|| shifted(whole, shape, &parts)) {
                return one;
            }
            let lists: Vec<&[Statement]> = parts.iter().map(|p| p.1.as_slice()).collect();
            match unify_lists(shapes, &lists, own) {
                Some(body) if !body.is_empty() && *size > 1 => vec![counted(own, *size, body)],
                _ => rows(shapes, &lists, own),
            }
        }
    }
}

/// The statements of elements, those of elements in a row as a loop where that is shorter.
fn rows(shapes: &dyn Shapes, lists: &[&[Statement]], depth: usize) -> Vec<Statement> {
    let (mut all, mut rest) = (vec![], lists);
    while let Some(first) = rest.first() {
        // Under other flags stands what is done at other times.
        let flags = |list: &[Statement]| list.iter().map(|s| s.flag().cloned()).collect::<Vec<_>>();
        let alike = |n: &usize| flags(rest[n - 1]) == flags(first) && unify_lists(shapes, &rest[..*n], depth).is_some();
        let size = (2..=rest.len()).take_while(alike).last().unwrap_or(1);
        // Two lines more than what is in it.
        if (size - 1) * first.iter().map(Statement::lines).sum::<usize>() > 2 {
            all.push(counted(depth, size, unify_lists(shapes, &rest[..size], depth).unwrap_or_default()));
            rest = &rest[size..];
        } else {
            all.extend_from_slice(first);
            rest = &rest[1..];
        }
    }
    all
}

/// A loop that counts from the number that all indices in it begin with.
fn counted(depth: usize, size: usize, body: Vec<Statement>) -> Statement {
    let mut first = None;
    let mut start = |index: &Index| {
        match index {
            Index::Loop { depth: own, plus, modulo } if *own == depth => {
                let plus = if modulo.is_some() { 0 } else { *plus };
                first = Some(first.map_or(plus, |first: usize| first.min(plus)));
            }
            _ => {}
        }
        index.clone()
    };
    body.iter().for_each(|statement| _ = statement.with_indices(&mut start));
    let first = first.unwrap_or(0);
    let mut less = |index: &Index| match index {
        Index::Loop { depth: own, plus, modulo } if *own == depth => {
            Index::Loop { depth, plus: plus.saturating_sub(first), modulo: *modulo }
        }
        other => other.clone(),
    };
    let body = body.iter().map(|statement| statement.with_indices(&mut less)).collect();
    Statement::Loop { depth, first, size, body }
}

/// One assignment of the whole instead of one for each part.
fn joined(shapes: &dyn Shapes, whole: &Name, shape: &Shape, parts: &[(Sub, Vec<Statement>)]) -> Option<Vec<Statement>> {
    let single = |(sub, list): &(Sub, Vec<Statement>)| match &list[..] {
        [one] => Some((sub.clone(), one.clone())),
        _ => None,
    };
    let parts: Vec<(Sub, Statement)> = parts.iter().map(single).collect::<Option<_>>()?;
    join(shapes, whole, shape, &parts).map(|one| vec![one])
}

/// Elements of which each becomes the one before it, under one flag: a shift register.
fn shifted(whole: &Name, shape: &Shape, parts: &[(Sub, Vec<Statement>)]) -> Option<Vec<Statement>> {
    fn loaded(statements: &[Statement]) -> Option<(Option<&Expression>, &Expression)> {
        match statements {
            [Statement::Assign(_, value)] => Some((None, value)),
            [Statement::If(flag, then, otherwise)] if otherwise.is_empty() => Some((Some(flag), loaded(then)?.1)),
            _ => None,
        }
    }
    let part = |sub: Sub| Name { base: whole.base.clone(), subs: [&whole.subs[..], &[sub]].concat() };
    let ((_, first), others) = parts.split_first().filter(|(_, others)| others.len() > 1)?;
    let flag = loaded(&others[0].1)?.0;
    let follows = |(i, (_, statements)): (usize, &(Sub, Vec<Statement>))| {
        let before = Expression::Name(part(Sub::Index(Index::At(i))));
        loaded(statements) == Some((flag, &before))
    };
    if !others.iter().enumerate().all(follows) {
        return None;
    }
    let under = |assign: Statement| match flag {
        Some(flag) => Statement::If(flag.clone(), vec![assign], vec![]),
        None => assign,
    };
    let (last, flags) = (others.len(), shape.is_flags());
    let of = |from: usize, to: usize| part(if flags { Sub::Range(to, from) } else { Sub::Range(from, to) });
    let before = Expression::Name(of(0, last - 1));
    Some(match loaded(first) {
        // A word of its own type, of which there is no doubt where it is joined with others.
        Some((own, value)) if own == flag && (flags || matches!(value, Expression::Name(_))) => {
            let value = if flags { before.binary("&", value.clone()) } else { value.clone().binary("&", before) };
            vec![under(Statement::Assign(whole.clone(), value))]
        }
        _ => [first.clone(), vec![under(Statement::Assign(of(1, last), before))]].concat(),
    })
}

fn join(shapes: &dyn Shapes, whole: &Name, shape: &Shape, parts: &[(Sub, Statement)]) -> Option<Statement> {
    match &parts.first()?.1 {
        Statement::Assign(..) => {
            let values: Option<Vec<(&Sub, &Expression)>> = parts
                .iter()
                .map(|(sub, statement)| match statement {
                    Statement::Assign(_, value) => Some((sub, value)),
                    _ => None,
                })
                .collect();
            Some(Statement::Assign(whole.clone(), join_values(shapes, shape, &values?)?))
        }
        Statement::If(condition, _, _) => {
            let mut inner = vec![];
            for (sub, statement) in parts {
                let Statement::If(other, then, otherwise) = statement else { return None };
                let [one] = &then[..] else { return None };
                if other != condition || !otherwise.is_empty() {
                    return None;
                }
                inner.push((sub.clone(), one.clone()));
            }
            Some(Statement::If(condition.clone(), vec![join(shapes, whole, shape, &inner)?], vec![]))
        }
        Statement::Instance { .. } | Statement::Loop { .. } => None,
    }
}

/// The value that has the given parts.
pub(super) fn join_values(shapes: &dyn Shapes, shape: &Shape, parts: &[(&Sub, &Expression)]) -> Option<Expression> {
    match parts.first()?.1 {
        Expression::Name(first) => {
            let mut whole = first.clone();
            whole.subs.pop()?;
            let fits = |(sub, value): &(&Sub, &Expression)| {
                matches!(value, Expression::Name(name)
                    if name.base == whole.base && name.subs.split_last() == Some((sub, &whole.subs[..])))
            };
            (parts.iter().all(fits) && shapes.part(&whole) == Some(shape)).then_some(Expression::Name(whole))
        }
        Expression::Select(index, legs) => {
            let mut joint = vec![];
            for k in 0..legs.len() {
                let mut of_leg = vec![];
                for (sub, value) in parts {
                    let Expression::Select(other, legs) = value else { return None };
                    if other != index {
                        return None;
                    }
                    of_leg.push((*sub, legs.get(k)?));
                }
                joint.push(join_values(shapes, shape, &of_leg)?);
            }
            Some(Expression::Select(index.clone(), joint))
        }
        _ => None,
    }
}

/// Lists of statements as one with a loop variable.
pub(super) fn unify_lists(shapes: &dyn Shapes, lists: &[&[Statement]], depth: usize) -> Option<Vec<Statement>> {
    let first = lists.first()?;
    if lists.iter().any(|l| l.len() != first.len()) {
        return None;
    }
    (0..first.len()).map(|k| unify(shapes, &lists.iter().map(|l| &l[k]).collect::<Vec<_>>(), depth)).collect()
}

fn unify(shapes: &dyn Shapes, all: &[&Statement], depth: usize) -> Option<Statement> {
    match all[0] {
        Statement::Assign(..) => {
            let mut targets = vec![];
            let mut values = vec![];
            for statement in all {
                let Statement::Assign(target, value) = statement else { return None };
                targets.push(target);
                values.push(value);
            }
            Some(Statement::Assign(unify_names(shapes, &targets, depth)?, unify_values(shapes, &values, depth)?))
        }
        Statement::If(..) => {
            let (mut conditions, mut then, mut otherwise) = (vec![], vec![], vec![]);
            for statement in all {
                let Statement::If(condition, a, b) = statement else { return None };
                conditions.push(condition);
                then.push(a.as_slice());
                otherwise.push(b.as_slice());
            }
            let condition = unify_values(shapes, &conditions, depth)?;
            let then = unify_lists(shapes, &then, depth)?;
            Some(Statement::If(condition, then, unify_lists(shapes, &otherwise, depth)?))
        }
        Statement::Instance { label, entity, connections } => {
            let mut whole = vec![];
            for (k, (formal, _)) in connections.iter().enumerate() {
                let mut actuals = vec![];
                for statement in all {
                    let Statement::Instance { label: other, connections, .. } = statement else { return None };
                    if other != label {
                        return None;
                    }
                    actuals.push(&connections[k].1);
                }
                whole.push((formal.clone(), unify_values(shapes, &actuals, depth)?));
            }
            Some(Statement::Instance { label: label.clone(), entity: entity.clone(), connections: whole })
        }
        Statement::Loop { depth: inner, first, size, .. } => {
            let mut bodies = vec![];
            for statement in all {
                let Statement::Loop { depth, first: start, size: other, body } = statement else { return None };
                if (depth, start, other) != (inner, first, size) {
                    return None;
                }
                bodies.push(body.as_slice());
            }
            let body = unify_lists(shapes, &bodies, depth)?;
            Some(Statement::Loop { depth: *inner, first: *first, size: *size, body })
        }
    }
}

/// The index that runs through the given ones.
fn run(numbers: &[usize], size: usize, depth: usize) -> Option<Index> {
    let plus = numbers[0];
    if numbers.iter().all(|n| *n == plus) {
        return Some(Index::At(plus));
    }
    if numbers.iter().enumerate().all(|(i, n)| *n == i + plus) {
        return Some(Index::Loop { depth, plus, modulo: None });
    }
    let around = |(i, n): (usize, &usize)| *n == (i + plus) % size;
    numbers.iter().enumerate().all(around).then_some(Index::Loop { depth, plus, modulo: Some(size) })
}

/// Names as one with a loop variable.
pub(super) fn unify_names(shapes: &dyn Shapes, all: &[&Name], depth: usize) -> Option<Name> {
    let first = all[0];
    if all.iter().any(|n| n.base != first.base || n.subs.len() != first.subs.len()) {
        return None;
    }
    let mut whole = Name::whole(first.base.clone());
    for k in 0..first.subs.len() {
        let sub = if all.iter().all(|n| n.subs[k] == first.subs[k]) {
            first.subs[k].clone()
        } else {
            let number = |n: &&Name| match n.subs[k] {
                Sub::Index(Index::At(i)) => Some(i),
                _ => None,
            };
            let numbers: Option<Vec<usize>> = all.iter().map(number).collect();
            let size = match shapes.part(&whole) {
                Some(Shape::Array { size, .. }) => *size,
                _ => usize::MAX,
            };
            Sub::Index(run(&numbers?, size, depth)?)
        };
        whole.subs.push(sub);
    }
    Some(whole)
}

/// Expressions as one with a loop variable.
pub(super) fn unify_values(shapes: &dyn Shapes, all: &[&Expression], depth: usize) -> Option<Expression> {
    let first = all[0];
    if all.iter().all(|e| *e == first) {
        return Some(first.clone());
    }
    if let Expression::Name(_) = first {
        let mut names = vec![];
        for value in all {
            let Expression::Name(name) = value else { return None };
            names.push(name);
        }
        return Some(Expression::Name(unify_names(shapes, &names, depth)?));
    }
    if let Expression::Number(_, ty) = first {
        // Small numbers that count with the loop.
        let number = |e: &&Expression| e.number().and_then(|n| usize::try_from(n).ok());
        let numbers: Option<Vec<usize>> = all.iter().map(number).collect();
        let index = run(&numbers?, all.len(), depth)?;
        return (!ty.is_flag()).then_some(Expression::Count(index, *ty));
    }
    let shell = |e: &Expression| e.with_parts(|_| Expression::Integer(0));
    if all.iter().any(|e| shell(e) != shell(first)) {
        return None;
    }
    let mut parts = vec![];
    for k in 0..first.parts().len() {
        let each: Vec<&Expression> = all.iter().map(|e| e.parts()[k]).collect();
        parts.push(unify_values(shapes, &each, depth)?);
    }
    let mut parts = parts.into_iter();
    Some(first.with_parts(|_| parts.next().expect("as many parts")))
}

/// A flag that a loop does not depend on, in front of the loop.
fn hoisted(statement: Statement) -> Statement {
    let Statement::Loop { depth, first, size, body } = statement else { return statement };
    let body: Vec<Statement> = body.into_iter().map(hoisted).collect();
    let flag = match &body[0] {
        Statement::If(flag, _, otherwise) if otherwise.is_empty() && !counts(flag, depth) => flag.clone(),
        _ => return Statement::Loop { depth, first, size, body },
    };
    if !body.iter().all(|s| matches!(s, Statement::If(other, _, rest) if *other == flag && rest.is_empty())) {
        return Statement::Loop { depth, first, size, body };
    }
    let inner = body.into_iter().flat_map(|s| match s {
        Statement::If(_, then, _) => then,
        other => vec![other],
    });
    Statement::If(flag, vec![Statement::Loop { depth, first, size, body: inner.collect() }], vec![])
}

/// Whether an expression depends on a loop variable.
fn counts(value: &Expression, depth: usize) -> bool {
    let counted = |index: &Index| matches!(index, Index::Loop { depth: own, .. } if *own == depth);
    match value {
        Expression::Name(name) => name.subs.iter().any(|sub| matches!(sub, Sub::Index(index) if counted(index))),
        Expression::Count(index, _) => counted(index),
        other => other.parts().into_iter().any(|part| counts(part, depth)),
    }
}

/// Neighbouring loops over the same values as one, and statements under the same flag together.
pub(super) fn merged(statements: Vec<Statement>) -> Vec<Statement> {
    let mut all: Vec<Statement> = vec![];
    for statement in statements.into_iter().map(hoisted) {
        // Registers of one flag belong together, wherever they come.
        if let Statement::If(flag, then, otherwise) = &statement {
            let same = |s: &&mut Statement| matches!(s, Statement::If(other, ..) if other == flag);
            if let Some(Statement::If(_, more, rest)) = all.iter_mut().find(same) {
                more.extend(then.iter().cloned());
                rest.extend(otherwise.iter().cloned());
                continue;
            }
        }
        match (all.last_mut(), statement) {
            (
                Some(Statement::Loop { depth, first, size, body }),
                Statement::Loop { depth: other_depth, first: other_first, size: other_size, body: more },
            ) if (*depth, *first, *size) == (other_depth, other_first, other_size) => body.extend(more),
            (_, statement) => all.push(statement),
        }
    }
    let inner = |statement| match statement {
        Statement::Loop { depth, first, size, body } => Statement::Loop { depth, first, size, body: merged(body) },
        Statement::If(condition, then, otherwise) => Statement::If(condition, merged(then), merged(otherwise)),
        other => other,
    };
    all.into_iter().map(inner).collect()
}
