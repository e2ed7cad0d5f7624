(** Where relative interiors meet, in signs: what docs/exact.md, sections 4 and 5, says of pairs that cross. Refuted by computation: that a
    pair does not cross by the rule though all six weights of a common point are positive ([crossing_refuted]), and that it crosses though
    some point has no positive weight in any common point ([through_refuted], [piercing_refuted], [plane_inside_refuted]). *)
From Coq Require Import List Bool PArith ZArith.
Require Import Efsat.Sign Efsat.Table Efsat.PlaneTable.
Import ListNotations.

(** Weights of a common point, of an edge and the other triangle, by the fifteen determinants: those of the six points. *)
Definition circuits : list (list (option signed)) :=
  let s v := Some (false, v) in let o v := Some (true, v) in
  [[s 5; o 4; None; s 8; s 9; s 7]; [None; s 6; o 5; s 11; s 12; s 10]; [o 6; None; s 4; s 14; s 15; s 13];
   [o 10; o 13; o 7; s 2; o 1; None]; [o 11; o 14; o 8; None; s 3; o 2]; [o 12; o 15; o 9; o 3; None; s 1]]%positive.
(** That none is negative, and that of point i positive. *)
Definition strict_at (i : nat) (m : bool) (c : list (option signed)) : list pattern :=
  match nth i c None with Some (b, v) => [(v, strict (xorb b m)) :: all_weak m (somes c)] | None => [] end.
Definition positive_at (i : nat) (cs : list (list (option signed))) : list pattern := flat_map (fun c => strict_at i false c ++ strict_at i true c) cs.

(** The sum of the sides of an edge is the difference of its ends. *)
Definition five_terms : list (list signed) :=
  map (fun '(b, (p, q, s0, s1, s2)) => [(false, q); (true, p); (negb b, s0); (negb b, s1); (negb b, s2)]) edge_list.
Definition chirotope : list pattern :=
  flat_map three (map pluecker quads) ++ flat_map (fun t => some_strict false t ++ some_strict true t) five_terms.

(** ** The rule of section 4 *)
Definition straddles (f : positive -> sign) (vs : list positive) : bool := existsb (fun v => seq (f v) P) vs && existsb (fun v => seq (f v) N) vs.
(** Edge k of A passes the plane of B on the inner side of edge l: ends, and side k l. *)
Definition passes (p q s : sign) : bool :=
  match p, q, s with N, O, P | N, P, P | O, P, P | P, O, N | P, N, N | O, N, N => true | _, _, _ => false end.
Definition through (l : positive) : list (positive * positive * positive) := [(4, 5, 6 + l); (5, 6, 9 + l); (6, 4, 12 + l)]%positive.
Definition passes_at (f : positive -> sign) '(p, q, s) : bool := passes (f p) (f q) (f s).
Definition crosses_outside (f : positive -> sign) : bool :=
  existsb (at_edge pierces f) edge_list ||
  (straddles f [1; 2; 3]%positive && straddles f [4; 5; 6]%positive && forallb (fun l => existsb (passes_at f) (through l)) [1; 2; 3]%positive).

Definition pierce_patterns (e : bool * (positive * positive * positive * positive * positive)) : list pattern :=
  let '(_, (p, q, s0, s1, s2)) := e in
  flat_map (fun '(x, y) => map (fun a => [(p, x); (q, y); (s0, a); (s1, a); (s2, a)]) [pos; neg]) [(pos, neg); (neg, pos)].
Definition all_pierce := flat_map pierce_patterns edge_list.
Definition straddle_patterns (vs : list positive) : list pattern := flat_map (fun v => map (fun w => [(v, pos); (w, neg)]) (filter (fun w => negb (Pos.eqb v w)) vs)) vs.
Definition one_sided (vs : list positive) : list pattern := [map (fun v => (v, ge)) vs; map (fun v => (v, le)) vs].
Definition pass_patterns '(p, q, s) : list pattern :=
  [[(p, neg); (q, ge); (s, pos)]; [(p, le); (q, pos); (s, pos)]; [(p, pos); (q, le); (s, neg)]; [(p, ge); (q, neg); (s, neg)]].
Definition no_pass_patterns '(p, q, s) : list pattern :=
  [[(s, zer)]; [(p, neg); (q, neg)]; [(p, zer); (q, zer)]; [(p, pos); (q, pos)];
   [(p, neg); (q, ge); (s, neg)]; [(p, le); (q, pos); (s, neg)]; [(p, pos); (q, le); (s, pos)]; [(p, ge); (q, neg); (s, pos)]].
Definition no_way (l : positive) : list pattern :=
  fold_right (fun t ps => both (no_pass_patterns t) ps) [[]] (through l).

(** Of a common point with positive weights. *)
Definition positive_facts : list pattern :=
  flat_map three (map cramer triples) ++ flat_map (fun t => some_strict false t ++ some_strict true t) five_terms
  ++ map (fun v => [(v, le)]) weights ++ all_zero [1; 2; 3; 4; 5; 6]%positive.
Definition demands : list (list pattern) :=
  [straddle_patterns [1; 2; 3]; straddle_patterns [4; 5; 6]]%positive ++ map (fun l => flat_map pass_patterns (through l)) [1; 2; 3]%positive.
Lemma crossing_refuted : forallb (fun d => refuted 30 (positive_facts ++ all_pierce ++ d)) demands = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

Definition six := List.seq 0 6.
Lemma through_refuted : forallb (fun i => refuted 30 (chirotope ++ all_pierce ++ one_sided [1; 2; 3]%positive ++ one_sided [4; 5; 6]%positive
  ++ flat_map no_way [1; 2; 3]%positive ++ positive_at i circuits)) six = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

Definition complement a := Set_ (negb (n_in a)) (negb (o_in a)) (negb (p_in a)).
Definition denied (x : pattern) : list pattern := map (fun '(v, a) => [(v, complement a)]) x.
Lemma piercing_refuted : forallb (fun x => forallb (fun i => refuted 30 (chirotope ++ denied x ++ positive_at i circuits)) six) all_pierce = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

(** ** The rule of section 5, in a plane *)
Definition nearly_parts (x0 x1 x2 area : sign) : bool :=
  let apart s t := negb (seq x0 s) && negb (seq x1 s) && negb (seq x2 s) && negb (seq area t) in
  (apart P N || apart N P) && negb (seq x0 O && seq x1 O && seq x2 O && seq area O).
Definition nearly_parts_edge (f : positive -> sign) (e : signed * signed * signed * signed) : bool :=
  let '(x0, x1, x2, a) := e in let s := signed_sign f false in nearly_parts (s x0) (s x1) (s x2) (s a).
Definition nearly_patterns (e : signed * signed * signed * signed) : list pattern :=
  let '(x0, x1, x2, (b, v)) := e in let t := [x0; x1; x2; (negb b, v)] in some_strict false t ++ some_strict true t.
Lemma plane_inside_refuted : forallb (fun i => refuted 30 (plane_facts ++ flat_map nearly_patterns plane_edges ++ positive_at i (map circuit quads))) six = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
