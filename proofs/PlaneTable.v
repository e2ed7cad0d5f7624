(** Six points in a plane: the signs of the twenty orientations of three of them. Refuted by computation: that no edge parts two
    triangles which have no common point ([plane_refuted]). *)
From Coq Require Import List Bool PArith ZArith.
Require Import Efsat.Sign Efsat.Table.
Import ListNotations.

(** The variable of the points i < j < k. *)
Fixpoint find_triple (t : nat * nat * nat) (l : list (nat * nat * nat)) (v : positive) : positive :=
  match l with
  | [] => v
  | u :: l => let '(i, j, k) := t in let '(i', j', k') := u in
      if (Nat.eqb i i' && Nat.eqb j j' && Nat.eqb k k')%bool then v else find_triple t l (Pos.succ v)
  end.
Definition tri i j k := find_triple (i, j, k) triples 1.

(** One is strictly on the side, the others are on it or 0. *)
Definition signed := (bool * positive)%type.
Definition weak (m : bool) := if m then le else ge.
Definition strict (m : bool) := if m then neg else pos.
Definition all_weak (m : bool) (ts : list signed) : pattern := map (fun '(b, v) => (v, weak (xorb b m))) ts.
Fixpoint some_strict (m : bool) (ts : list signed) : list pattern :=
  match ts with
  | [] => []
  | (b, v) :: ts => ((v, strict (xorb b m)) :: all_weak m ts) :: map (cons (v, weak (xorb b m))) (some_strict m ts)
  end.
Definition signed_sign (f : positive -> sign) (m : bool) (t : signed) : sign := let '(b, v) := t in if xorb b m then sopp (f v) else f v.

Lemma all_weak_holds f m ts : holds f (all_weak m ts) = true -> Forall (fun t => signed_sign f m t <> N) ts.
Proof.
  induction ts as [|[b v] ts IH]; cbn; [constructor|]. rewrite andb_true_iff. intros [A B]. constructor; auto.
  cbn. destruct (xorb b m), (f v); cbn in *; congruence.
Qed.
Lemma some_strict_holds f m ts x : In x (some_strict m ts) -> holds f x = true ->
  Forall (fun t => signed_sign f m t <> N) ts /\ Exists (fun t => signed_sign f m t = P) ts.
Proof.
  revert x; induction ts as [|[b v] ts IH]; cbn; intros x; [tauto|]. intros [<-|I].
  - cbn. rewrite andb_true_iff. intros [A B]. apply all_weak_holds in B.
    assert (E : signed_sign f m (b, v) = P) by (cbn; destruct (xorb b m), (f v); cbn in *; congruence).
    split; [constructor; auto; cbn in *; congruence|now constructor].
  - apply in_map_iff in I as (y & <- & I). cbn. rewrite andb_true_iff. intros [A B]. destruct (IH _ I B) as [F G].
    split; [constructor; auto|now constructor 2]. cbn. destruct (xorb b m), (f v); cbn in *; congruence.
Qed.

(** [abc][ade] - [abd][ace] + [abe][acd] = 0, and so on: five points, one of them in front. *)
Definition oriented (i j k : nat) : bool * positive :=
  if Nat.ltb i j then if Nat.ltb j k then (false, tri i j k) else if Nat.ltb i k then (true, tri i k j) else (false, tri k i j)
  else if Nat.ltb i k then (true, tri j i k) else if Nat.ltb j k then (false, tri j k i) else (true, tri k j i).
Definition gp '(a, b, c, d, e) : term * term * term :=
  let t (minus : bool) i j k l := let '(m, v) := oriented a i j in let '(n, w) := oriented a k l in (xorb minus (xorb m n), v, w) in
  (t false b c d e, t true b d c e, t false b e c d).
Definition fives : list (nat * nat * nat * nat * nat) :=
  flat_map (fun a => map (fun '(b, c, d, e) => (a, b, c, d, e))
    (filter (fun '(b, c, d, e) => negb (Nat.eqb a b || Nat.eqb a c || Nat.eqb a d || Nat.eqb a e)) quads)) [0; 1; 2; 3; 4; 5]%nat.

(** Four points: the sum of their orientations with alternating signs is 0, and they are weights of 0. *)
Definition affine '(a, b, c, d) : list signed := [(false, tri b c d); (true, tri a c d); (false, tri a b d); (true, tri a b c)].
Definition circuit (q : nat * nat * nat * nat) : list (option signed) :=
  let '(a, b, c, d) := q in
  map (fun i => let of_b := Nat.leb 3 i in
    if Nat.eqb i a then Some (of_b, tri b c d) else if Nat.eqb i b then Some (negb of_b, tri a c d)
    else if Nat.eqb i c then Some (of_b, tri a b d) else if Nat.eqb i d then Some (negb of_b, tri a b c) else None) [0; 1; 2; 3; 4; 5]%nat.
Definition somes {A} (l : list (option A)) : list A := flat_map (fun o => match o with Some x => [x] | None => [] end) l.

(** An edge, and what is on its sides: the three points of the other triangle, and its own area. *)
Definition plane_edges : list (signed * signed * signed * signed) :=
  let e t o k := let '(i, j) := nth k [(nth 0 t 0, nth 1 t 0); (nth 1 t 0, nth 2 t 0); (nth 2 t 0, nth 0 t 0)] (0, 0) in
    (oriented i j (nth 0 o 0), oriented i j (nth 1 o 0), oriented i j (nth 2 o 0), oriented (nth 0 t 0) (nth 1 t 0) (nth 2 t 0)) in
  (map (e [0; 1; 2] [3; 4; 5]) [0; 1; 2] ++ map (e [3; 4; 5] [0; 1; 2]) [0; 1; 2])%nat.
Definition part_patterns (e : signed * signed * signed * signed) : list pattern :=
  let '((b0, v0), (b1, v1), (b2, v2), (b, v)) := e in
  map (fun m => [(v0, strict (xorb b0 m)); (v1, strict (xorb b1 m)); (v2, strict (xorb b2 m)); (v, weak (negb (xorb b m)))]) [true; false].
Definition parts (x0 x1 x2 area : sign) : bool :=
  ((seq x0 N && seq x1 N && seq x2 N && negb (seq area N)) || (seq x0 P && seq x1 P && seq x2 P && negb (seq area P)))%bool.
Definition parts_edge (f : positive -> sign) (e : signed * signed * signed * signed) : bool :=
  let '(x0, x1, x2, a) := e in let s := signed_sign f false in parts (s x0) (s x1) (s x2) (s a).
Lemma part_patterns_part f e x : In x (part_patterns e) -> holds f x = true -> parts_edge f e = true.
Proof.
  destruct e as [[[[b0 v0] [b1 v1]] [b2 v2]] [b v]]. cbn.
  intros [<-|[<-|[]]]; cbn; destruct b0, b1, b2, b, (f v0), (f v1), (f v2), (f v); cbn; congruence.
Qed.

(** The moments: n, m_0, m_1, m_2 along the coordinate. *)
Definition plane_moments : list positive := [tri 0 1 2; tri 0 3 4; tri 0 4 5; tri 0 3 5].

Definition plane_facts := flat_map three (map gp fives) ++ flat_map (fun q => some_strict false (affine q) ++ some_strict true (affine q)) quads
  ++ all_zero plane_moments.
Definition circuit_patterns := flat_map (fun q => some_strict false (somes (circuit q)) ++ some_strict true (somes (circuit q))) quads.
Lemma plane_refuted : refuted 30 (plane_facts ++ circuit_patterns ++ flat_map part_patterns plane_edges) = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
