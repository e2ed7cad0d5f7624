(** The interval operators of the axis unit, section 2 of docs/proofs.md: sums, differences, products by sign cases enclose what the same operation yields of the true numbers. Bounds are integers, true numbers real. *)
From Coq Require Import ZArith Reals Lra Lia Psatz Bool.
Local Open Scope Z_scope.
Record interval := I { lo : Z; hi : Z }.
Definition encloses (a : interval) (x : R) : Prop := (IZR (lo a) <= x <= IZR (hi a))%R.
Definition sum a b := I (lo a + lo b) (hi a + hi b).
Definition difference a b := I (lo a - hi b) (hi a - lo b).
(** As in gen/unit/golden/interval.rs. *)
Definition product a b :=
  let minus := lo a <? 0 in let plus := 0 <? hi a in
  let straddling := minus && plus && (lo b <? 0) && (0 <? hi b) in
  let reach := Z.max (hi b) (- lo b) in
  let l := if straddling then - reach else lo b in let h := if straddling then reach else hi b in
  I (Z.min (lo a * (if minus then h else l)) (hi a * (if plus then l else h)))
    (Z.max (lo a * (if minus then l else h)) (hi a * (if plus then h else l))).

Lemma sum_encloses a b x y : encloses a x -> encloses b y -> encloses (sum a b) (x + y).
Proof. unfold encloses; cbn. rewrite !plus_IZR. lra. Qed.
Lemma difference_encloses a b x y : encloses a x -> encloses b y -> encloses (difference a b) (x - y).
Proof. unfold encloses; cbn. rewrite !minus_IZR. lra. Qed.

Lemma IZR_min a b : IZR (Z.min a b) = Rmin (IZR a) (IZR b).
Proof. destruct (Z.min_spec a b) as [[H ->]|[H ->]]; [rewrite Rmin_left|rewrite Rmin_right]; auto; apply IZR_le; lia. Qed.
Lemma IZR_max a b : IZR (Z.max a b) = Rmax (IZR a) (IZR b).
Proof. destruct (Z.max_spec a b) as [[H ->]|[H ->]]; [rewrite Rmax_right|rewrite Rmax_left]; auto; apply IZR_le; lia. Qed.
(** A number between the ends times y is between what the ends make of y. *)
Lemma between a b x y l h : (a <= x <= b)%R -> (l <= a * y <= h)%R -> (l <= b * y <= h)%R -> (l <= x * y <= h)%R.
Proof. intros. destruct (Rle_or_lt 0 y); nra. Qed.

Theorem product_encloses a b x y : encloses a x -> encloses b y -> encloses (product a b) (x * y).
Proof.
  intros A B. unfold product, encloses. cbn [lo hi].
  set (s := (lo a <? 0) && (0 <? hi a) && (lo b <? 0) && (0 <? hi b)).
  set (r := Z.max (hi b) (- lo b)). set (l := if s then - r else lo b). set (h := if s then r else hi b).
  assert (B' : (IZR l <= y <= IZR h)%R).
  { unfold encloses in B. unfold l, h. destruct s; auto. unfold r. rewrite opp_IZR, IZR_max, opp_IZR.
    pose proof (Rmax_l (IZR (hi b)) (- IZR (lo b))). pose proof (Rmax_r (IZR (hi b)) (- IZR (lo b))). lra. }
  rewrite IZR_min, IZR_max, !mult_IZR.
  assert (L : (IZR (lo a) * IZR (if lo a <? 0 then h else l) <= IZR (lo a) * y <= IZR (lo a) * IZR (if lo a <? 0 then l else h))%R).
  { destruct (Z.ltb_spec (lo a) 0) as [H|H]; [apply IZR_lt in H|apply IZR_le in H]; nra. }
  assert (U : (IZR (hi a) * IZR (if 0 <? hi a then l else h) <= IZR (hi a) * y <= IZR (hi a) * IZR (if 0 <? hi a then h else l))%R).
  { destruct (Z.ltb_spec 0 (hi a)) as [H|H]; [apply IZR_lt in H|apply IZR_le in H]; nra. }
  eapply between; [exact A| |].
  - split; [eapply Rle_trans; [apply Rmin_l|apply L]|eapply Rle_trans; [apply L|apply Rmax_l]].
  - split; [eapply Rle_trans; [apply Rmin_r|apply U]|eapply Rle_trans; [apply U|apply Rmax_r]].
Qed.
