(** The fifteen determinants of docs/determinants.md as an antisymmetric table: entry i j is the minor of the six points without i
    and j.

    Three sets of sign conditions that are refuted by computation: a common point without an edge that hits ([common_refuted]), eleven
    axes that overlap without one ([axes_refuted]), and in Five.v five missed edges. *)
From Coq Require Import List Bool PArith ZArith.
Require Import Efsat.Sign.
Import ListNotations.
Local Open Scope positive_scope.

(** 0 for 1, and so on. *)
Fixpoint place (v : positive) : nat := match v with xH => 0 | xO v => S (place v + place v) | xI v => S (S (place v + place v)) end%nat.

(** Variables: plane_a 1 to 3, plane_b 4 to 6, side k l 7 + 3 k + l, weights of the six points 16 to 21. *)
Definition table : list (list Z) := [
  [  0;   6;  -5; 11; 12; 10]; [ -6;   0;   4; 14; 15; 13]; [  5;  -4;   0;  8;  9;  7];
  [-11; -14;  -8;  0;  3; -2]; [-12; -15;  -9; -3;  0;  1]; [-10; -13;  -7;  2; -1;  0]]%Z.
Definition entry (i j : nat) : bool * positive :=
  match nth j (nth i table []) 0%Z with Zpos v => (false, v) | Zneg v => (true, v) | Z0 => (false, 1) end.
Definition weight_of (i : nat) : positive := nth i [16; 17; 18; 19; 20; 21] 16.

Definition triples := [(0,1,2); (0,1,3); (0,1,4); (0,1,5); (0,2,3); (0,2,4); (0,2,5); (0,3,4); (0,3,5); (0,4,5);
  (1,2,3); (1,2,4); (1,2,5); (1,3,4); (1,3,5); (1,4,5); (2,3,4); (2,3,5); (2,4,5); (3,4,5)]%nat.
Definition quads := [(0,1,2,3); (0,1,2,4); (0,1,2,5); (0,1,3,4); (0,1,3,5); (0,1,4,5); (0,2,3,4); (0,2,3,5); (0,2,4,5);
  (0,3,4,5); (1,2,3,4); (1,2,3,5); (1,2,4,5); (1,3,4,5); (2,3,4,5)]%nat.
(** x_i D_jk - x_j D_ik + x_k D_ij = 0 *)
Definition cramer '(i, j, k) : term * term * term :=
  let t (minus : bool) x y z := let '(m, v) := entry y z in (xorb minus m, weight_of x, v) in
  (t false i j k, t true j i k, t false k i j).
(** D_ij D_kl - D_ik D_jl + D_il D_jk = 0 *)
Definition pluecker '(i, j, k, l) : term * term * term :=
  let t (minus : bool) x y z u := let '(m, v) := entry x y in let '(n, w) := entry z u in (xorb minus (xorb m n), v, w) in
  (t false i j k l, t true i k j l, t false i l j k).

(** An edge with the ends p and q and the sides s: what contradicts that it hits, for an edge of A. *)
Definition hit_patterns (flip_sides : bool) (p q s0 s1 s2 : positive) : list pattern :=
  let up := if flip_sides then le else ge in let down := if flip_sides then ge else le in
  let sides a := [(s0, a); (s1, a); (s2, a)] in
  [(q, pos) :: (p, le) :: sides up; (q, ge) :: (p, neg) :: sides up;
   (q, neg) :: (p, ge) :: sides down; (q, le) :: (p, pos) :: sides down].
(** Impossible because q - p is the sum of the sides, or its opposite. *)
Definition sum_patterns (p q s0 s1 s2 : positive) : list pattern :=
  flat_map (fun '(st, al) => map (fun '(i, j, k) => [(p, zer); (q, zer); (i, st); (j, al); (k, al)])
    [(s0, s1, s2); (s1, s2, s0); (s2, s0, s1)]) [(pos, ge); (neg, le)].

(** Edges: ends, sides, and whether it is one of B. *)
Definition edge_list : list (bool * (positive * positive * positive * positive * positive)) :=
  [(false, (4, 5, 7, 8, 9)); (false, (5, 6, 10, 11, 12)); (false, (6, 4, 13, 14, 15));
   (true, (1, 2, 7, 10, 13)); (true, (2, 3, 8, 11, 14)); (true, (3, 1, 9, 12, 15))].
Definition hit_list (es : list (bool * (positive * positive * positive * positive * positive))) :=
  flat_map (fun '(f, (p, q, s0, s1, s2)) => hit_patterns f p q s0 s1 s2) es.
Definition sum_list := flat_map (fun '(_, (p, q, s0, s1, s2)) => sum_patterns p q s0 s1 s2) edge_list.
Definition all_zero (vs : list positive) : list pattern := [map (fun v => (v, zer)) vs].
Definition determinants := [1; 2; 3; 4; 5; 6; 7; 8; 9; 10; 11; 12; 13; 14; 15].
Definition weights := [16; 17; 18; 19; 20; 21].
Definition negative_weight : list pattern := map (fun v => [(v, neg)]) weights.

Definition facts := flat_map three (map cramer triples) ++ sum_list ++ negative_weight ++ all_zero weights ++ all_zero determinants.

Lemma common_refuted : refuted 30 (facts ++ hit_list edge_list) = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

(** What hits, of an edge. *)
Definition misses (p q s0 s1 s2 : sign) : bool :=
  (seq (smul p q) P || ((seq s0 P || seq s1 P || seq s2 P) && (seq s0 N || seq s1 N || seq s2 N)))%bool.
Definition hits p q s0 s1 s2 : bool := (negb (misses p q s0 s1 s2) && negb (seq p O && seq q O))%bool.
Definition at_edge {A} (g : sign -> sign -> sign -> sign -> sign -> A) (f : positive -> sign) (e : bool * (positive * positive * positive * positive * positive)) : A :=
  let '(_, (p, q, s0, s1, s2)) := e in g (f p) (f q) (f s0) (f s1) (f s2).
Definition pierces p q s0 s1 s2 : bool :=
  (seq (smul p q) N && ((seq s0 P && seq s1 P && seq s2 P) || (seq s0 N && seq s1 N && seq s2 N)))%bool.
Lemma hit_patterns_hit f b p q s0 s1 s2 x : In x (hit_patterns b p q s0 s1 s2) -> holds f x = true ->
  hits (f p) (f q) (f s0) (f s1) (f s2) = true.
Proof.
  destruct b; cbn; intros [<-|[<-|[<-|[<-|[]]]]]; cbn;
  destruct (f p), (f q), (f s0), (f s1), (f s2); cbn; auto.
Qed.

(** The patterns of the eleven axes: each of them separates the pair weakly. *)
Definition axis_patterns : list pattern :=
  map (map (fun v => (v, ge))) [[1; 2; 3]; [4; 5; 6]] ++ map (map (fun v => (v, le))) [[1; 2; 3]; [4; 5; 6]] ++
  flat_map (fun '(a, a', ss) => flat_map (fun '(b, b', s) =>
    [[(s, ge); (a, le); (a', ge); (b, ge); (b', le)]; [(s, le); (a, ge); (a', le); (b, le); (b', ge)]]) ss)
  [(1, 2, [(4, 5, 7); (5, 6, 10); (6, 4, 13)]); (2, 3, [(4, 5, 8); (5, 6, 11); (6, 4, 14)]); (3, 1, [(4, 5, 9); (5, 6, 12); (6, 4, 15)])].
Lemma axes_refuted : refuted 30 (flat_map three (map pluecker quads) ++ sum_list ++ axis_patterns ++ hit_list edge_list) = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
