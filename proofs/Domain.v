(** Integers and real numbers as one: an ordered integral domain, given by a ring and the sign of a number. What is proved of any domain
    holds of both. A module type lists what an instance has to prove; both instances prove it. *)
From Coq Require Import List Bool PArith ZArith Lia Ring Reals Lra.
Require Import Efsat.Sign.
Import ListNotations.

Module Type DOM.
  Parameter C : Type.
  Parameters zero one : C.
  Parameters add mul sub : C -> C -> C.
  Parameter opp : C -> C.
  Axiom th : ring_theory zero one add mul sub opp (@eq C).
  Parameter sg : C -> sign.
  Axiom sg_zero : forall x, sg x = O <-> x = zero.
  Axiom sg_one : sg one = P.
  Axiom sg_mul : forall x y, sg (mul x y) = smul (sg x) (sg y).
  Axiom sg_opp : forall x, sg (opp x) = sopp (sg x).
  Axiom sg_add : forall x y, sg x <> N -> sg y = P -> sg (add x y) = P.
End DOM.

Module Integers <: DOM.
  Definition C := Z.
  Definition zero := 0%Z. Definition one := 1%Z.
  Definition add := Z.add. Definition mul := Z.mul. Definition sub := Z.sub. Definition opp := Z.opp.
  Lemma th : ring_theory zero one add mul sub opp (@eq C). Proof. exact Zth. Qed.
  Definition sg (x : Z) := match x with Z0 => O | Zpos _ => P | Zneg _ => N end.
  Lemma sg_zero x : sg x = O <-> x = zero. Proof. unfold zero. destruct x; cbn; split; congruence. Qed.
  Lemma sg_one : sg one = P. Proof. reflexivity. Qed.
  Lemma sg_mul x y : sg (mul x y) = smul (sg x) (sg y). Proof. destruct x, y; reflexivity. Qed.
  Lemma sg_opp x : sg (opp x) = sopp (sg x). Proof. destruct x; reflexivity. Qed.
  Lemma sg_P x : sg x = P <-> (0 < x)%Z. Proof. destruct x; cbn; split; intros; try lia; try congruence; reflexivity. Qed.
  Lemma sg_N x : sg x = N <-> (x < 0)%Z. Proof. destruct x; cbn; split; intros; try lia; try congruence; reflexivity. Qed.
  Lemma sg_add x y : sg x <> N -> sg y = P -> sg (add x y) = P.
  Proof. rewrite sg_N, !sg_P. unfold add. lia. Qed.
End Integers.

Module RealNumbers <: DOM.
  Local Open Scope R_scope.
  Definition C := R.
  Definition zero := 0. Definition one := 1.
  Definition add := Rplus. Definition mul := Rmult. Definition sub := Rminus. Definition opp := Ropp.
  Lemma th : ring_theory zero one add mul sub opp (@eq C). Proof. exact (F_R Rfield). Qed.
  Definition sg (x : R) := match total_order_T x 0 with inleft (left _) => N | inleft (right _) => O | inright _ => P end.
  Lemma sg_zero x : sg x = O <-> x = 0.
  Proof. unfold sg. destruct (total_order_T x 0) as [[]|]; split; intros; try discriminate; try lra; auto. Qed.
  Lemma sg_P x : sg x = P <-> 0 < x.
  Proof. unfold sg. destruct (total_order_T x 0) as [[]|]; split; intros; try discriminate; try lra; auto. Qed.
  Lemma sg_N x : sg x = N <-> x < 0.
  Proof. unfold sg. destruct (total_order_T x 0) as [[]|]; split; intros; try discriminate; try lra; auto. Qed.
  Lemma sg_one : sg one = P. Proof. apply sg_P. unfold one. lra. Qed.
  Lemma sg_opp x : sg (opp x) = sopp (sg x).
  Proof. unfold opp. destruct (sg x) eqn:E; cbn; [apply sg_N in E; apply sg_P|apply sg_zero in E; apply sg_zero|apply sg_P in E; apply sg_N]; lra. Qed.
  Lemma sg_mul x y : sg (mul x y) = smul (sg x) (sg y).
  Proof.
    unfold mul. destruct (sg x) eqn:E, (sg y) eqn:F; cbn;
      rewrite ?sg_N, ?sg_P, ?sg_zero in *; rewrite ?E, ?F; try lra; nra.
  Qed.
  Lemma sg_add x y : sg x <> N -> sg y = P -> sg (add x y) = P.
  Proof. rewrite sg_N, !sg_P. unfold add. lra. Qed.
End RealNumbers.

(** What follows for signs of sums. *)
Module Facts (D : DOM).
  Import D.
  Add Ring domain : th.
  Declare Scope dom.
  Notation "0" := zero : dom. Notation "1" := one : dom.
  Infix "+" := add : dom. Infix "*" := mul : dom. Infix "-" := sub : dom. Notation "- x" := (opp x) : dom.
  Local Open Scope dom.

  Lemma sg0 : sg 0 = O. Proof. now apply sg_zero. Qed.
  Lemma sg_add_cases x y : sg (x + y) = match sg x, sg y with O, s => s | s, O => s | P, P => P | N, N => N | _, _ => sg (x + y) end.
  Proof.
    destruct (sg x) eqn:X, (sg y) eqn:Y; auto; try (apply sg_zero in X; subst x); try (apply sg_zero in Y; subst y).
    - assert (K : sg (- (x + y)) = P).
      { replace (- (x + y)) with (- x + - y) by ring. apply sg_add; rewrite sg_opp, ?X, ?Y; cbn; congruence. }
      rewrite sg_opp in K. now destruct (sg (x + y)).
    - now replace (x + 0) with x by ring.
    - now replace (0 + y) with y by ring.
    - now replace (0 + 0) with 0 by ring; rewrite sg0.
    - now replace (0 + y) with y by ring.
    - now replace (x + 0) with x by ring.
    - apply sg_add; congruence.
  Qed.

  Lemma sum3 x y z : x + y + z = 0 -> balanced (sg x) (sg y) (sg z) = true.
  Proof.
    intros H. assert (K : sg (x + y) = sopp (sg z)).
    { replace (x + y) with (- z) by (replace (x + y) with (x + y + z + - z) by ring; rewrite H; ring). apply sg_opp. }
    rewrite sg_add_cases in K. destruct (sg x), (sg y), (sg z); cbn in *; congruence || reflexivity.
  Qed.

  Lemma cancel x y : x * y = 0 -> x = 0 \/ y = 0.
  Proof.
    intros H. apply sg_zero in H. rewrite sg_mul in H. rewrite <- !sg_zero. destruct (sg x), (sg y); cbn in H; auto; discriminate.
  Qed.

  (** Numbers for variables. *)
  Definition tval (val : positive -> C) (t : term) : C := let '(m, i, j) := t in if m then - (val i * val j) else val i * val j.
  Lemma tval_sign val t : sg (tval val t) = term_sign (fun v => sg (val v)) t.
  Proof. destruct t as [[[] i] j]; cbn; rewrite ?sg_opp, sg_mul; reflexivity. Qed.
  Definition zero_sum val (t : term * term * term) : Prop := let '(a, b, c) := t in tval val a + tval val b + tval val c = 0.
  Lemma zero_sums val ts p : Forall (zero_sum val) ts -> In p (flat_map three ts) -> holds (fun v => sg (val v)) p = true -> False.
  Proof.
    intros A I H. apply in_flat_map in I as ([[a b] c] & I & J).
    rewrite Forall_forall in A. specialize (A _ I). cbn in A. apply sum3 in A. rewrite !tval_sign in A.
    pose proof (three_sound _ _ _ _ _ J H). congruence.
  Qed.

  Definition sum (xs : list C) : C := fold_right add 0 xs.
  Lemma sum_ge xs : Forall (fun x => sg x <> N) xs -> sg (sum xs) <> N /\ (Exists (fun x => sg x = P) xs -> sg (sum xs) = P).
  Proof.
    induction 1 as [|x xs Hx H [I J]].
    - cbn; rewrite sg0. split; [discriminate|]. intros K; inversion K.
    - change (sum (x :: xs)) with (x + sum xs). rewrite sg_add_cases. split.
      + destruct (sg x) eqn:?, (sg (sum xs)) eqn:?; congruence.
      + intros K; inversion K as [? ? E|? ? E]; subst; [rewrite E|specialize (J E); rewrite J]; destruct (sg (sum xs)) eqn:?, (sg x) eqn:?; congruence.
  Qed.
End Facts.
