(** The fifteen determinants and their bounds: sections 4 and 5 of docs/determinants.md, proved as in its sections 7.4 and 7.5.

    If each coordinate of the five points is wrong by at most eps = 1/2 + 2^(level-3), then each of the fifteen numbers, times
    2^s, differs from the true determinant by at most an eighth of its bound, times 2^s: [errors]. This holds for every width N
    from 6 on, every shift s from 0 to N, every level from 0 to 6, and the four kinds of bounds. So a sign that is called certain
    is that of the true determinant: [signs_certain]. *)
From Coq Require Import ZArith Reals Lra Lia Psatz List Bool.
Require Import Efsat.Triple Efsat.Vectors.
Import ListNotations.
Local Open Scope Z_scope.

(** * What the unit computes *)
Record zvec := Z3 { ZX : Z; ZY : Z; ZZ : Z }.
Definition zminus u v := Z3 (ZX u - ZX v) (ZY u - ZY v) (ZZ u - ZZ v).
Definition zcross u v := Z3 (ZY u * ZZ v - ZZ u * ZY v) (ZZ u * ZX v - ZX u * ZZ v) (ZX u * ZY v - ZY u * ZX v).
Definition zdot u v := ZX u * ZX v + ZY u * ZY v + ZZ u * ZZ v.
Definition znorm u := Z.abs (ZX u) + Z.abs (ZY u) + Z.abs (ZZ u).
Definition round (x s : Z) := (x + 2 ^ s / 2) / 2 ^ s.
Definition zround s u := Z3 (round (ZX u) s) (round (ZY u) s) (round (ZZ u) s).

(** The points beside V0, which is the origin. *)
Record points := Points { V1 : zvec; V2 : zvec; W : triple zvec }.
Record moments := Moments { m : triple zvec; n : zvec }.
Definition exact_moments x := Moments (tab (fun l => zcross (W x l) (W x (next l)))) (zcross (V1 x) (V2 x)).
Definition rounded s r := Moments (tab (fun l => zround s (m r l))) (zround s (n r)).

(** Something for each of the fifteen. *)
Record fifteen := Fifteen { plane_a : triple Z; plane_b : triple Z; side : triple (triple Z) }.
Definition to_list {A} (t : triple A) := [t T0; t T1; t T2].
Definition all_of f := to_list (plane_a f) ++ to_list (plane_b f) ++ to_list (side f T0) ++ to_list (side f T1) ++ to_list (side f T2).

(** Section 4: the dot products and the determinants, from rounded moments. *)
Definition numbers x r :=
  let a := tab (fun l => zdot (n r) (W x l)) in
  let d1 := tab (fun l => zdot (V1 x) (m r l)) in let d2 := tab (fun l => zdot (V2 x) (m r l)) in
  let v := zdot (W x T0) (m r T1) in
  Fifteen a (Tri v (v - (d1 T0 + d1 T1 + d1 T2)) (v - (d2 T0 + d2 T1 + d2 T2)))
    (Tri (tab (fun l => - d1 l)) (tab (fun l => d1 l - d2 l + a l - a (next l))) d2).

(** Section 5: the bounds, in eighths of 2^s. *)
Inductive kind := Static | Edges | Norms | Products.
Definition F level x := 4 * x + 2 ^ level * x.
Definition c N s level k := 8 * 2 ^ (N + 1 - s + k + 2 * Z.max (level - 2) 0).
(** |x x y|, from leading bits. *)
Definition leading N z := (z + 2 ^ (N - 6) - 1) / 2 ^ (N - 6).
Definition product N s x y :=
  let t := leading N in let all := znorm y in
  let sum := t (Z.abs (ZX x)) * t (all - Z.abs (ZX y)) + t (Z.abs (ZY x)) * t (all - Z.abs (ZY y)) + t (Z.abs (ZZ x)) * t (all - Z.abs (ZZ y)) in
  let power := 2 * (N - 6) - s in
  if 0 <=? power then sum * 2 ^ power else sum / 2 ^ (- power) + 1.
Section Bounds.
  Variable k : kind. Variables N s level : Z.
  Variable x : points. Variable r : moments.
  Definition e_a1 := zminus (V2 x) (V1 x).
  Definition e_b l := zminus (W x (next l)) (W x l).
  Definition g y := 2 ^ (N - s) * y.
  Definition of_m l := match k with Edges => g (znorm (e_b l)) | _ => znorm (m r l) end.
  Definition of_n := match k with Edges => g (znorm e_a1) | _ => znorm (n r) end.
  Definition of_vertex v l := match k with Products => product N s v (W x l) | _ => g (Z.min (znorm v) (znorm (W x l))) end.
  Definition of_edge_b v l := match k with Products => product N s v (e_b l) | _ => g (znorm (e_b l)) end.
  Definition of_edge_a l := match k with Products => product N s e_a1 (W x l) | _ => g (znorm e_a1) end.
  (** F of the sum of norms, and the sum of lengths; `static` has constants for them. *)
  Let R := 2 ^ (N - 1).
  Let q := R * 2 ^ (N + 1 - s) / 4.
  Definition three_points f l := (match k with Static => F level (12 * q) + 12 * R | _ => F level f + l end) + c N s level 3.
  Definition four_points f l := (match k with Static => F level (48 * q) + 48 * R | _ => F level f + l end) + c N s level 5.
  Definition bounds :=
    let S := of_m T0 + of_m T1 + of_m T2 in
    let corner v := four_points (2 * S + (of_edge_b v T0 + of_edge_b v T1 + of_edge_b v T2)) (4 * znorm (W x T0) + 12 * znorm v) in
    let ends v l := three_points (of_m l + of_vertex v l + of_vertex v (next l)) (4 * znorm v) in
    Fifteen (tab (fun l => three_points (of_n + of_vertex (V1 x) l + of_vertex (V2 x) l) (4 * znorm (W x l))))
      (Tri (three_points S (4 * znorm (W x T0))) (corner (V1 x)) (corner (V2 x)))
      (Tri (tab (ends (V1 x)))
        (tab (fun l => four_points (2 * of_m l + 2 * of_n + of_edge_b (V1 x) l + of_edge_b (V2 x) l + of_edge_a l + of_edge_a (next l))
          (4 * (znorm e_a1 + znorm (e_b l)))))
        (tab (ends (V2 x)))).
End Bounds.

(** * Integers as real numbers *)
Definition real u := V3 (IZR (ZX u)) (IZR (ZY u)) (IZR (ZZ u)).
Lemma round_error x s : 0 <= s -> (Rabs (IZR (round x s) * IZR (2 ^ s) - IZR x) <= IZR (2 ^ s) / 2)%R.
Proof.
  intros Hs. assert (P : 0 < 2 ^ s) by (apply Z.pow_pos_nonneg; lia). unfold round.
  assert (K : - 2 ^ s <= 2 * ((x + 2 ^ s / 2) / 2 ^ s * 2 ^ s - x) <= 2 ^ s).
  { pose proof (Z.mul_div_le (x + 2 ^ s / 2) (2 ^ s) P). pose proof (Z.mul_succ_div_gt (x + 2 ^ s / 2) (2 ^ s) P).
    destruct (Z.eq_dec s 0) as [->|Ns]; [change (2 ^ 0) with 1 in *; change (1 / 2) with 0 in *; rewrite Z.div_1_r in *; lia|].
    assert (E : 2 ^ s = 2 * 2 ^ (s - 1)) by (rewrite <- Z.pow_succ_r by lia; f_equal; lia).
    assert (D : 2 ^ s / 2 = 2 ^ (s - 1)) by (rewrite E, Z.mul_comm; apply Z.div_mul; lia). nia. }
  destruct K as [K1 K2]. apply IZR_le in K1, K2. rewrite ?opp_IZR, ?mult_IZR, ?minus_IZR, ?mult_IZR in *.
  apply Rabs_le. lra.
Qed.
Lemma real_cross u v : real (zcross u v) = cross (real u) (real v).
Proof. unfold real, cross; cbn. now rewrite !minus_IZR, !mult_IZR. Qed.
Lemma real_minus u v : real (zminus u v) = minus (real u) (real v).
Proof. unfold real, minus, zminus; cbn. now rewrite !minus_IZR. Qed.
Lemma real_dot u v : IZR (zdot u v) = dot (real u) (real v).
Proof. unfold zdot, dot; cbn. now rewrite !plus_IZR, !mult_IZR. Qed.
Lemma real_norm u : IZR (znorm u) = norm (real u).
Proof. unfold znorm, norm; cbn. now rewrite !plus_IZR, !abs_IZR. Qed.
Lemma IZR_min a b : IZR (Z.min a b) = Rmin (IZR a) (IZR b).
Proof. destruct (Z.min_spec a b) as [[H ->]|[H ->]]; [rewrite Rmin_left|rewrite Rmin_right]; auto; apply IZR_le; lia. Qed.
Lemma norm_plus u v : (norm (plus u v) <= norm u + norm v)%R.
Proof.
  unfold norm, plus; cbn. pose proof (Rabs_triang (X u) (X v)). pose proof (Rabs_triang (Y u) (Y v)). pose proof (Rabs_triang (Z_ u) (Z_ v)). lra.
Qed.
Lemma norm_minus r u v : within r u -> within r v -> (norm (minus u v) <= 6 * r)%R.
Proof.
  intros (A & B & C) (A' & B' & C'). unfold norm, minus, Rminus; cbn.
  pose proof (Rabs_triang (X u) (- X v)). pose proof (Rabs_triang (Y u) (- Y v)). pose proof (Rabs_triang (Z_ u) (- Z_ v)).
  rewrite !Rabs_Ropp in *. lra.
Qed.

Definition fits (N : Z) u := Z.abs (ZX u) <= 2 ^ (N - 1) - 1 /\ Z.abs (ZY u) <= 2 ^ (N - 1) - 1 /\ Z.abs (ZZ u) <= 2 ^ (N - 1) - 1.
Lemma fits_within N u : fits N u -> within (IZR (2 ^ (N - 1)) - 1) (real u).
Proof.
  intros (A & B & C). unfold within, real; cbn. rewrite <- !abs_IZR, <- minus_IZR. repeat split; apply IZR_le; auto.
Qed.
Definition eps level := (1 / 2 + IZR (2 ^ level) / 8)%R.

(** * Errors and bounds *)
Section Errors.
  Variable k : kind. Variables N s level : Z.
  Hypothesis HN : 6 <= N. Hypothesis Hs : 0 <= s <= N. Hypothesis Hl : 0 <= level <= 6.
  Let RR := IZR (2 ^ (N - 1)). Let U := IZR (2 ^ s). Let G := IZR (2 ^ (N - s)).

  Lemma powers : (32 <= RR /\ 1 <= U /\ U * G = 2 * RR /\ U <= 2 * RR)%R.
  Proof.
    unfold RR, U, G. rewrite <- mult_IZR, <- Z.pow_add_r by lia. replace (s + (N - s)) with (Z.succ (N - 1)) by lia.
    rewrite Z.pow_succ_r, mult_IZR by lia. repeat split; try lra.
    - apply (IZR_le 32). change 32 with (2 ^ 5). apply Z.pow_le_mono_r; lia.
    - apply (IZR_le 1). assert (0 < 2 ^ s) by (apply Z.pow_pos_nonneg; lia). lia.
    - rewrite <- mult_IZR, <- Z.pow_succ_r by lia. apply IZR_le, Z.pow_le_mono_r; lia.
  Qed.
  Lemma eps_pos : (1 / 2 < eps level)%R.
  Proof. unfold eps. assert (0 < 2 ^ level) as K by (apply Z.pow_pos_nonneg; lia). apply IZR_lt in K. lra. Qed.
  Lemma F_eps x : IZR (F level x) = (8 * eps level * IZR x)%R.
  Proof. unfold F, eps. rewrite plus_IZR, !mult_IZR. lra. Qed.
  Lemma c_value i : 0 <= i -> (IZR (c N s level i) * U = 32 * 2 ^ Z.to_nat i * IZR (2 ^ (2 * Z.max (level - 2) 0)) * RR)%R.
  Proof.
    intros Hk. destruct powers as (_ & _ & E & _). unfold c. replace (N + 1 - s + i + 2 * Z.max (level - 2) 0) with (1 + i + 2 * Z.max (level - 2) 0 + (N - s)) by lia.
    rewrite !Z.pow_add_r, !mult_IZR by lia. fold G.
    assert (P : IZR (2 ^ i) = (2 ^ Z.to_nat i)%R) by (rewrite <- (Z2Nat.id i) at 1 by lia; now rewrite <- pow_IZR).
    rewrite P. change (2 ^ 1) with 2. nra.
  Qed.

  (** A number C that is wrong by l / 8 before its corners move, and f, a bound on the norms of the faces in units of 2^s. The
      first term is that of first order, c(3) has room for the second and the third and for what rounded norms lack. *)
  Lemma three_corners p q r dp dq dr C f l : within (RR - 1) p -> within (RR - 1) q -> within (RR - 1) r ->
    within (eps level) dp -> within (eps level) dq -> within (eps level) dr ->
    (8 * Rabs (IZR C * U - dot (cross p q) r) <= IZR l * U)%R ->
    (norm (cross p q) + norm (cross q r) + norm (cross r p) <= (IZR f + 9 / 2) * U)%R ->
    (8 * Rabs (IZR C * U - dot (cross (plus p dp) (plus q dq)) (plus r dr)) <= IZR (F level f + l + c N s level 3) * U)%R.
  Proof.
    intros P Q R Dp Dq Dr E S. destruct powers as (PR & PU & PG & PS). pose proof eps_pos as He.
    pose proof (Vectors.three_points (eps level) p q r dp dq dr ltac:(lra) Dp Dq Dr) as T.
    pose proof (within_norm _ _ P). pose proof (within_norm _ _ Q). pose proof (within_norm _ _ R).
    set (near := dot (cross p q) r) in *. set (true := dot (cross (plus p dp) (plus q dq)) (plus r dr)) in *.
    assert (K : (Rabs (IZR C * U - true) <= Rabs (IZR C * U - near) + Rabs (true - near))%R).
    { replace (IZR C * U - true)%R with ((IZR C * U - near) + - (true - near))%R by ring. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
    rewrite !plus_IZR, F_eps, !Rmult_plus_distr_r, c_value by lia. change (Z.to_nat 3) with 3%nat.
    set (e := eps level) in *.
    assert (Fine : (8 * e * (9 / 2 * U) + 16 * e * e * (9 * (RR - 1)) + 48 * e * e * e <= 256 * IZR (2 ^ (2 * Z.max (level - 2) 0)) * RR)%R).
    { clear - PR PU PS Hl. unfold e, eps.
      assert (L : level = 0 \/ level = 1 \/ level = 2 \/ level = 3 \/ level = 4 \/ level = 5 \/ level = 6) by lia.
      destruct L as [->|[->|[->|[->|[->|[->| ->]]]]]]; cbn -[IZR]; lra. }
    assert (K1 : (e * (norm (cross p q) + norm (cross q r) + norm (cross r p)) <= e * ((IZR f + 9 / 2) * U))%R) by (apply Rmult_le_compat_l; lra).
    assert (K2 : (2 * e * e * (norm p + norm q + norm r) <= 2 * e * e * (9 * (RR - 1)))%R) by (apply Rmult_le_compat_l; nra).
    lra.
  Qed.
  (** The same for a tetrahedron whose four corners move. *)
  Definition volume a p q r := dot (cross (minus p a) (minus q a)) (minus r a).
  Lemma four_corners a p q r da dp dq dr C f l : within (RR - 1) a -> within (RR - 1) p -> within (RR - 1) q -> within (RR - 1) r ->
    within (eps level) da -> within (eps level) dp -> within (eps level) dq -> within (eps level) dr ->
    (8 * Rabs (IZR C * U - volume a p q r) <= IZR l * U)%R ->
    (norm (cross (minus p a) (minus q a)) + norm (cross (minus q a) (minus r a)) + norm (cross (minus r a) (minus p a))
      + norm (cross (minus q p) (minus r p)) <= (IZR f + 9) * U)%R ->
    (8 * Rabs (IZR C * U - volume (plus a da) (plus p dp) (plus q dq) (plus r dr)) <= IZR (F level f + l + c N s level 5) * U)%R.
  Proof.
    intros A P Q R Da Dp Dq Dr E S. destruct powers as (PR & PU & PG & PS). pose proof eps_pos as He.
    pose proof (Vectors.four_points (eps level) a p q r da dp dq dr ltac:(lra) Da Dp Dq Dr) as T. cbv zeta beta in T.
    pose proof (norm_minus _ _ _ P A). pose proof (norm_minus _ _ _ Q A). pose proof (norm_minus _ _ _ R A).
    pose proof (norm_minus _ _ _ Q P). pose proof (norm_minus _ _ _ R Q). pose proof (norm_minus _ _ _ P R).
    unfold volume in *. set (near := dot (cross (minus p a) (minus q a)) (minus r a)) in *.
    match type of T with (Rabs (?t - near) <= _)%R => set (true := t) in * end.
    assert (K : (Rabs (IZR C * U - true) <= Rabs (IZR C * U - near) + Rabs (true - near))%R).
    { replace (IZR C * U - true)%R with ((IZR C * U - near) + - (true - near))%R by ring. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
    rewrite !plus_IZR, F_eps, !Rmult_plus_distr_r, c_value by lia. change (Z.to_nat 5) with 5%nat.
    set (e := eps level) in *.
    assert (Fine : (8 * e * (9 * U) + 16 * e * e * (36 * (RR - 1)) + 192 * e * e * e <= 1024 * IZR (2 ^ (2 * Z.max (level - 2) 0)) * RR)%R).
    { clear - PR PU PS Hl. unfold e, eps.
      assert (L : level = 0 \/ level = 1 \/ level = 2 \/ level = 3 \/ level = 4 \/ level = 5 \/ level = 6) by lia.
      destruct L as [->|[->|[->|[->|[->|[->| ->]]]]]]; cbn -[IZR]; lra. }
    match type of S with (?z <= _)%R => assert (K1 : (e * z <= e * ((IZR f + 9) * U))%R) by (apply Rmult_le_compat_l; lra) end.
    match type of T with (_ <= _ + 2 * _ * _ * ?z + _)%R => assert (K2 : (2 * e * e * z <= 2 * e * e * (36 * (RR - 1)))%R) by (apply Rmult_le_compat_l; nra) end.
    lra.
  Qed.

  (** Section 7.4: a rounded moment in a dot product. *)
  Lemma moment_error v : within (U / 2) (minus (V3 (X (real (zround s v)) * U) (Y (real (zround s v)) * U) (Z_ (real (zround s v)) * U)) (real v)).
  Proof. unfold within, minus, real, zround; cbn. repeat split; apply round_error; lia. Qed.
  Lemma dot_error v w : (Rabs (IZR (zdot (zround s v) w) * U - dot (real v) (real w)) <= U / 2 * norm (real w))%R.
  Proof.
    pose proof (dot_bound _ _ (real w) (moment_error v)) as K. rewrite real_dot.
    match type of K with (Rabs ?a <= _)%R => match goal with |- (Rabs ?b <= _)%R => replace b with a by (unfold dot, minus; cbn; ring) end end. exact K.
  Qed.
  (** A rounded moment may be shorter than the true one, by 3/2. *)
  Lemma moment_norm v : (norm (real v) <= (IZR (znorm (zround s v)) + 3 / 2) * U)%R.
  Proof.
    destruct (moment_error v) as (A & B & C). destruct powers as (_ & PU & _). rewrite real_norm. unfold norm, minus in *. cbn in *.
    assert (T : (forall a b, Rabs (a * U - b) <= U / 2 -> Rabs b <= Rabs a * U + U / 2)%R).
    { intros a b H. rewrite <- (Rabs_pos_eq U) at 1 by lra. rewrite <- Rabs_mult.
      pose proof (Rabs_triang (a * U) (- (a * U - b))). rewrite Rabs_Ropp in *. replace (a * U + - (a * U - b))%R with b in * by ring. lra. }
    apply T in A, B, C. lra.
  Qed.
  (** Norms of faces: the table of section 5. *)
  Lemma g_norm e v u : within (RR - 1) (real v) -> (norm (real u) <= IZR e)%R -> (norm (cross (real u) (real v)) <= IZR (g N s e) * U)%R.
  Proof.
    intros A B. destruct powers as (PR & PU & E & _). unfold g. rewrite mult_IZR. fold G.
    pose proof (cross_norm _ (real u) _ A) as K. pose proof (norm_pos (real u)). nra.
  Qed.
  Lemma min_norm u v : within (RR - 1) (real u) -> within (RR - 1) (real v) ->
    (norm (cross (real u) (real v)) <= IZR (g N s (Z.min (znorm u) (znorm v))) * U)%R.
  Proof.
    intros A B. destruct powers as (PR & PU & E & _). unfold g. rewrite mult_IZR, IZR_min, !real_norm. fold G.
    pose proof (cross_norm_min _ _ _ A B) as K.
    assert (PM : (0 <= Rmin (norm (real u)) (norm (real v)))%R) by (apply Rmin_glb; apply norm_pos). nra.
  Qed.
  Lemma leading_above z : z <= leading N z * 2 ^ (N - 6).
  Proof.
    unfold leading. assert (P : 0 < 2 ^ (N - 6)) by (apply Z.pow_pos_nonneg; lia).
    pose proof (Z.mul_succ_div_gt (z + 2 ^ (N - 6) - 1) (2 ^ (N - 6)) P). lia.
  Qed.
  Lemma product_norm u v : (norm (cross (real u) (real v)) <= IZR (product N s u v) * U)%R.
  Proof.
    assert (P : 0 < 2 ^ (N - 6)) by (apply Z.pow_pos_nonneg; lia).
    set (D := 2 ^ (N - 6)) in *.
    assert (T : forall a b, 0 <= a -> 0 <= b -> a * b <= leading N a * leading N b * (D * D)).
    { intros a b A B. pose proof (leading_above a) as LA. pose proof (leading_above b) as LB. fold D in LA, LB. nia. }
    pose proof (T (Z.abs (ZX u)) (znorm v - Z.abs (ZX v)) ltac:(lia) ltac:(unfold znorm; lia)) as A.
    pose proof (T (Z.abs (ZY u)) (znorm v - Z.abs (ZY v)) ltac:(lia) ltac:(unfold znorm; lia)) as B.
    pose proof (T (Z.abs (ZZ u)) (znorm v - Z.abs (ZZ v)) ltac:(lia) ltac:(unfold znorm; lia)) as C.
    assert (K : znorm (zcross u v) <= product N s u v * 2 ^ s).
    { unfold product. cbv zeta. set (sum := leading N (Z.abs (ZX u)) * _ + _ + _).
      assert (L : znorm (zcross u v) <= sum * (D * D)).
      { transitivity (Z.abs (ZX u) * (znorm v - Z.abs (ZX v)) + Z.abs (ZY u) * (znorm v - Z.abs (ZY v)) + Z.abs (ZZ u) * (znorm v - Z.abs (ZZ v))); [|unfold sum; lia].
        unfold znorm, zcross; cbn.
        assert (M : forall a b c d, Z.abs (a * b - c * d) <= Z.abs a * Z.abs b + Z.abs c * Z.abs d) by (intros; rewrite <- !Z.abs_mul; lia).
        pose proof (M (ZY u) (ZZ v) (ZZ u) (ZY v)). pose proof (M (ZZ u) (ZX v) (ZX u) (ZZ v)). pose proof (M (ZX u) (ZY v) (ZY u) (ZX v)). lia. }
      assert (DD : D * D = 2 ^ (2 * (N - 6))) by (unfold D; rewrite <- Z.pow_add_r by lia; f_equal; lia).
      rewrite DD in L. destruct (Z.leb_spec 0 (2 * (N - 6) - s)) as [H|H].
      - rewrite <- Z.mul_assoc, <- Z.pow_add_r by lia. replace (2 * (N - 6) - s + s) with (2 * (N - 6)) by lia. exact L.
      - assert (P' : 0 < 2 ^ (- (2 * (N - 6) - s))) by (apply Z.pow_pos_nonneg; lia).
        pose proof (Z.mul_succ_div_gt sum _ P') as M.
        assert (E : 2 ^ s = 2 ^ (- (2 * (N - 6) - s)) * 2 ^ (2 * (N - 6))) by (rewrite <- Z.pow_add_r by lia; f_equal; lia). rewrite E.
        assert (0 < 2 ^ (2 * (N - 6))) by (apply Z.pow_pos_nonneg; lia). nia. }
    apply IZR_le in K. rewrite mult_IZR, real_norm, real_cross in K. exact K.
  Qed.

  (** ** One pair *)
  Variable x : points.
  Hypothesis F1 : fits N (V1 x). Hypothesis F2 : fits N (V2 x). Hypothesis FW : forall l, fits N (W x l).
  Let r := rounded s (exact_moments x).
  Variables d1 d2 : vec. Variable d : three -> vec.
  Hypothesis D1 : within (eps level) d1. Hypothesis D2 : within (eps level) d2. Hypothesis DW : forall l, within (eps level) (d l).
  (** The true points. *)
  Let v1 := plus (real (V1 x)) d1. Let v2 := plus (real (V2 x)) d2. Let w l := plus (real (W x l)) (d l).
  Let in1 := fits_within _ _ F1. Let in2 := fits_within _ _ F2. Let inW l := fits_within _ _ (FW l).

  Definition near C f t := (8 * Rabs (IZR C * U - t) <= IZR f * U)%R.
  Lemma rounded_m l : m r l = zround s (zcross (W x l) (W x (next l))).
  Proof. unfold r, rounded, exact_moments. cbn -[tab]. now rewrite !get_tab. Qed.
  Lemma q_value : (IZR (2 ^ (N - 1) * 2 ^ (N + 1 - s) / 4) * U = RR * RR)%R.
  Proof.
    assert (E : 2 ^ (N - 1) * 2 ^ (N + 1 - s) / 4 = 2 ^ (2 * N - 2 - s)).
    { rewrite <- Z.pow_add_r by lia. change 4 with (2 ^ 2). replace (N - 1 + (N + 1 - s)) with (2 * N - 2 - s + 2) by lia.
      rewrite Z.pow_add_r by lia. apply Z.div_mul. lia. }
    rewrite E. unfold U, RR. rewrite <- !mult_IZR, <- !Z.pow_add_r by lia. f_equal. f_equal. lia.
  Qed.

  Lemma norm_m l : k <> Static -> (norm (cross (real (W x l)) (real (W x (next l)))) <= (IZR (of_m k N s x r l) + 3 / 2) * U)%R.
  Proof.
    intros K. destruct powers as (_ & PU & _). unfold of_m. rewrite rounded_m.
    pose proof (moment_norm (zcross (W x l) (W x (next l)))) as A. rewrite real_cross in A.
    destruct k; try exact A.
    assert (E : cross (real (W x l)) (real (W x (next l))) = cross (real (W x l)) (real (e_b x l))) by (unfold e_b; rewrite real_minus; unfold cross, minus; cbn; f_equal; ring).
    rewrite E, norm_opp_cross.
    pose proof (g_norm (znorm (e_b x l)) (W x l) (e_b x l) (inW l) ltac:(rewrite real_norm; lra)) as B. lra.
  Qed.
  Lemma norm_n : k <> Static -> (norm (cross (real (V1 x)) (real (V2 x))) <= (IZR (of_n k N s x r) + 3 / 2) * U)%R.
  Proof.
    intros K. destruct powers as (_ & PU & _). unfold of_n. change (n r) with (zround s (zcross (V1 x) (V2 x))).
    pose proof (moment_norm (zcross (V1 x) (V2 x))) as A. rewrite real_cross in A.
    destruct k; try exact A.
    assert (E : cross (real (V1 x)) (real (V2 x)) = cross (real (V1 x)) (real (e_a1 x))) by (unfold e_a1; rewrite real_minus; unfold cross, minus; cbn; f_equal; ring).
    rewrite E, norm_opp_cross.
    pose proof (g_norm (znorm (e_a1 x)) (V1 x) (e_a1 x) in1 ltac:(rewrite real_norm; lra)) as B. lra.
  Qed.
  Lemma norm_vertex v l : fits N v -> (norm (cross (real v) (real (W x l))) <= IZR (of_vertex k N s x v l) * U)%R.
  Proof. intros A. unfold of_vertex. destruct k; first [apply product_norm|apply min_norm; apply fits_within; auto]. Qed.
  Lemma norm_edge_b v l : fits N v -> (norm (cross (real v) (real (e_b x l))) <= IZR (of_edge_b k N s x v l) * U)%R.
  Proof. intros A. unfold of_edge_b. destruct k; first [apply product_norm|rewrite norm_opp_cross; apply g_norm; [apply fits_within; auto|rewrite real_norm; lra]]. Qed.
  Lemma norm_edge_a l : (norm (cross (real (e_a1 x)) (real (W x l))) <= IZR (of_edge_a k N s x l) * U)%R.
  Proof. unfold of_edge_a. destruct k; first [apply product_norm|apply g_norm; [apply inW|rewrite real_norm; lra]]. Qed.

  (** A determinant with V0 as a corner, and one with four others. *)
  Lemma three_near p q u dp dq du C f l : fits N p -> fits N q -> fits N u ->
    within (eps level) dp -> within (eps level) dq -> within (eps level) du ->
    (8 * Rabs (IZR C * U - dot (cross (real p) (real q)) (real u)) <= IZR l * U)%R -> (IZR l <= 12 * (RR - 1))%R ->
    (k <> Static -> (norm (cross (real p) (real q)) + norm (cross (real q) (real u)) + norm (cross (real u) (real p)) <= (IZR f + 9 / 2) * U)%R) ->
    near C (three_points k N s level f l) (dot (cross (plus (real p) dp) (plus (real q) dq)) (plus (real u) du)).
  Proof.
    intros P Q R Dp Dq Dr E L S. destruct powers as (PR & PU & _). apply fits_within in P, Q, R. fold RR in P, Q, R.
    unfold near, three_points. destruct k; try (apply three_corners; auto; apply S; discriminate).
    apply three_corners; auto.
    - eapply Rle_trans; [exact E|]. apply Rmult_le_compat_r; [lra|]. rewrite mult_IZR. fold RR. lra.
    - rewrite mult_IZR. pose proof q_value as V. pose proof (cross_cube _ _ _ P Q). pose proof (cross_cube _ _ _ Q R). pose proof (cross_cube _ _ _ R P). nra.
  Qed.
  Lemma four_near a p q u da dp dq du C f l : fits N a -> fits N p -> fits N q -> fits N u ->
    within (eps level) da -> within (eps level) dp -> within (eps level) dq -> within (eps level) du ->
    (8 * Rabs (IZR C * U - volume (real a) (real p) (real q) (real u)) <= IZR l * U)%R -> (IZR l <= 48 * (RR - 1))%R ->
    (k <> Static -> (norm (cross (minus (real p) (real a)) (minus (real q) (real a))) + norm (cross (minus (real q) (real a)) (minus (real u) (real a)))
      + norm (cross (minus (real u) (real a)) (minus (real p) (real a))) + norm (cross (minus (real q) (real p)) (minus (real u) (real p))) <= (IZR f + 9) * U)%R) ->
    near C (four_points k N s level f l) (volume (plus (real a) da) (plus (real p) dp) (plus (real q) dq) (plus (real u) du)).
  Proof.
    intros A P Q R Da Dp Dq Dr E L S. destruct powers as (PR & PU & _). apply fits_within in A, P, Q, R. fold RR in A, P, Q, R.
    unfold near, four_points. destruct k; try (apply four_corners; auto; apply S; discriminate).
    apply four_corners; auto.
    - eapply Rle_trans; [exact E|]. apply Rmult_le_compat_r; [lra|]. rewrite mult_IZR. fold RR. lra.
    - rewrite mult_IZR. pose proof q_value as V.
      assert (T : forall a p q, within (RR - 1) a -> within (RR - 1) p -> within (RR - 1) q -> (norm (cross (minus p a) (minus q a)) <= 12 * (RR - 1) * (RR - 1))%R).
      { clear - RR. intros a p q A P Q. replace (cross (minus p a) (minus q a)) with (plus (plus (cross p q) (cross q a)) (cross a p)) by (unfold plus, cross, minus; cbn; f_equal; ring).
        pose proof (norm_plus (plus (cross p q) (cross q a)) (cross a p)). pose proof (norm_plus (cross p q) (cross q a)).
        pose proof (cross_cube _ _ _ P Q). pose proof (cross_cube _ _ _ Q A). pose proof (cross_cube _ _ _ A P). lra. }
      pose proof (T _ _ _ A P Q). pose proof (T _ _ _ A Q R). pose proof (T _ _ _ A R P). pose proof (T _ _ _ P Q R). nra.
  Qed.

  Lemma norm_fits v : fits N v -> (IZR (znorm v) <= 3 * (RR - 1))%R.
  Proof. intros A. rewrite real_norm. apply within_norm. now apply fits_within. Qed.

  Lemma plane_a_near l : near (plane_a (numbers x r) l) (plane_a (bounds k N s level x r) l) (dot (cross v1 v2) (w l)).
  Proof.
    cbn -[tab Z.mul Z.add]. rewrite !get_tab. apply three_near; auto.
    - pose proof (dot_error (zcross (V1 x) (V2 x)) (W x l)) as E. rewrite real_cross in E. rewrite mult_IZR, real_norm.
      change (n r) with (zround s (zcross (V1 x) (V2 x))). lra.
    - rewrite mult_IZR. pose proof (norm_fits _ (FW l)). lra.
    - intros K. pose proof (norm_n K). pose proof (norm_vertex (V1 x) l F1) as A. pose proof (norm_vertex (V2 x) l F2).
      rewrite norm_opp_cross in A. rewrite !plus_IZR. destruct powers as (_ & PU & _). lra.
  Qed.
  Lemma plane_b_0_near : near (plane_b (numbers x r) T0) (plane_b (bounds k N s level x r) T0) (dot (cross (w T1) (w T2)) (w T0)).
  Proof.
    cbn -[tab Z.mul Z.add]. apply three_near; auto.
    - pose proof (dot_error (zcross (W x T1) (W x T2)) (W x T0)) as E. rewrite real_cross in E. rewrite mult_IZR, real_norm.
      rewrite rounded_m. cbn [next]. replace (zdot (W x T0) (zround s (zcross (W x T1) (W x T2)))) with (zdot (zround s (zcross (W x T1) (W x T2))) (W x T0)) by (unfold zdot; ring). lra.
    - rewrite mult_IZR. pose proof (norm_fits _ (FW T0)). lra.
    - intros K. pose proof (norm_m T0 K). pose proof (norm_m T1 K). pose proof (norm_m T2 K). cbn [next] in *. rewrite !plus_IZR.
      destruct powers as (_ & PU & _). lra.
  Qed.
  (** Of side 0 and side 2. *)
  Lemma end_near v dv l C : fits N v -> within (eps level) dv -> C = zdot v (m r l) \/ C = - zdot v (m r l) ->
    let u := plus (real v) dv in let bound := three_points k N s level (of_m k N s x r l + of_vertex k N s x v l + of_vertex k N s x v (next l)) (4 * znorm v) in
    (C = zdot v (m r l) -> near C bound (dot (cross (w l) (w (next l))) u)) /\ (C = - zdot v (m r l) -> near C bound (dot (cross (w (next l)) (w l)) u)).
  Proof.
    intros Fv Dv _ u bound. pose proof (dot_error (zcross (W x l) (W x (next l))) v) as E. rewrite real_cross, <- rounded_m in E.
    assert (Z : zdot v (m r l) = zdot (m r l) v) by (unfold zdot; ring). rewrite Z. clear Z.
    pose proof (norm_fits _ Fv) as Nv. destruct powers as (_ & PU & _).
    split; intros ->; apply three_near; auto; try (rewrite mult_IZR; lra).
    - rewrite mult_IZR, real_norm. lra.
    - intros K. pose proof (norm_m l K). pose proof (norm_vertex v l Fv). pose proof (norm_vertex v (next l) Fv) as A.
      rewrite norm_opp_cross in A. rewrite !plus_IZR. lra.
    - rewrite mult_IZR, real_norm, opp_IZR.
      replace (- IZR (zdot (m r l) v) * U - dot (cross (real (W x (next l))) (real (W x l))) (real v))%R with
        (- (IZR (zdot (m r l) v) * U - dot (cross (real (W x l)) (real (W x (next l)))) (real v)))%R by (unfold dot, cross; cbn; ring).
      rewrite Rabs_Ropp. lra.
    - intros K. pose proof (norm_m l K) as B. pose proof (norm_vertex v l Fv) as A. pose proof (norm_vertex v (next l) Fv).
      rewrite norm_opp_cross in A, B. rewrite !plus_IZR. lra.
  Qed.
  Lemma corner_near v dv : fits N v -> within (eps level) dv ->
    near (zdot (W x T0) (m r T1) - (zdot v (m r T0) + zdot v (m r T1) + zdot v (m r T2)))
      (four_points k N s level (2 * (of_m k N s x r T0 + of_m k N s x r T1 + of_m k N s x r T2) + (of_edge_b k N s x v T0 + of_edge_b k N s x v T1 + of_edge_b k N s x v T2))
        (4 * znorm (W x T0) + 12 * znorm v))
      (volume (plus (real v) dv) (w T0) (w T1) (w T2)).
  Proof.
    intros Fv Dv. destruct powers as (_ & PU & _). apply four_near; auto.
    - pose proof (dot_error (zcross (W x T1) (W x T2)) (W x T0)) as E. rewrite real_cross in E.
      pose proof (dot_error (zcross (W x T0) (W x T1)) v) as E0. rewrite real_cross in E0.
      pose proof (dot_error (zcross (W x T1) (W x T2)) v) as E1. rewrite real_cross in E1.
      pose proof (dot_error (zcross (W x T2) (W x T0)) v) as E2. rewrite real_cross in E2.
      rewrite !rounded_m. cbn [next].
      assert (Z : forall a b, zdot a b = zdot b a) by (intros; unfold zdot; ring).
      rewrite (Z (W x T0)), !(Z v). rewrite minus_IZR, !plus_IZR, !mult_IZR, !real_norm.
      match type of E with (Rabs ?a <= _)%R => match type of E0 with (Rabs ?b <= _)%R => match type of E1 with (Rabs ?c <= _)%R => match type of E2 with (Rabs ?d <= _)%R =>
        match goal with |- (8 * Rabs ?e <= _)%R => replace e with (a + - b + - c + - d)%R by (unfold volume, dot, cross, minus; cbn; ring) end end end end end.
      match goal with |- (8 * Rabs ?e <= _)%R => triangle e end. rewrite !Rabs_Ropp in *. lra.
    - rewrite plus_IZR, !mult_IZR. pose proof (norm_fits _ (FW T0)). pose proof (norm_fits _ Fv). lra.
    - intros K. pose proof (norm_m T0 K). pose proof (norm_m T1 K). pose proof (norm_m T2 K). cbn [next] in *.
      pose proof (norm_edge_b v T0 Fv). pose proof (norm_edge_b v T1 Fv). pose proof (norm_edge_b v T2 Fv).
      assert (T : forall l, (norm (cross (minus (real (W x l)) (real v)) (minus (real (W x (next l))) (real v))) <=
        norm (cross (real (W x l)) (real (W x (next l)))) + norm (cross (real v) (real (e_b x l))))%R).
      { intros l. rewrite (norm_opp_cross (real v)).
        replace (cross (minus (real (W x l)) (real v)) (minus (real (W x (next l))) (real v))) with
          (plus (cross (real (W x l)) (real (W x (next l)))) (cross (real (e_b x l)) (real v)))
          by (unfold e_b; rewrite real_minus; unfold plus, cross, minus; cbn; f_equal; ring). apply norm_plus. }
      pose proof (T T0). pose proof (T T1). pose proof (T T2). cbn [next] in *.
      assert (B : (norm (cross (minus (real (W x T1)) (real (W x T0))) (minus (real (W x T2)) (real (W x T0)))) <=
        norm (cross (real (W x T0)) (real (W x T1))) + norm (cross (real (W x T1)) (real (W x T2))) + norm (cross (real (W x T2)) (real (W x T0))))%R).
      { replace (cross (minus (real (W x T1)) (real (W x T0))) (minus (real (W x T2)) (real (W x T0)))) with
          (plus (plus (cross (real (W x T0)) (real (W x T1))) (cross (real (W x T1)) (real (W x T2)))) (cross (real (W x T2)) (real (W x T0))))
          by (unfold plus, cross, minus; cbn; f_equal; ring).
        eapply Rle_trans; [apply norm_plus|]. pose proof (norm_plus (cross (real (W x T0)) (real (W x T1))) (cross (real (W x T1)) (real (W x T2)))). lra. }
      rewrite !plus_IZR, !mult_IZR, !plus_IZR. lra.
  Qed.
  Lemma side_1_near l : near (side (numbers x r) T1 l) (side (bounds k N s level x r) T1 l) (volume v1 v2 (w (next l)) (w l)).
  Proof.
    cbn -[tab Z.mul Z.add Z.sub]. rewrite !get_tab. destruct powers as (_ & PU & _). apply four_near; auto.
    - set (e := minus (real (V2 x)) (real (V1 x))). set (b := minus (real (W x (next l))) (real (W x l))).
      pose proof (dot_bound _ _ e (moment_error (zcross (W x l) (W x (next l))))) as R1. pose proof (dot_bound _ _ b (moment_error (zcross (V1 x) (V2 x)))) as R2.
      rewrite !real_cross in *.
      rewrite minus_IZR, plus_IZR, minus_IZR, !real_dot, mult_IZR, plus_IZR, !real_norm. unfold e_a1, e_b. rewrite !real_minus. fold e b.
      match goal with |- (8 * Rabs ?z <= _)%R => match type of R1 with (Rabs ?y <= _)%R => match type of R2 with (Rabs ?t <= _)%R =>
        replace z with (- y + - t)%R by (unfold volume, e, b, dot, cross, minus; cbn; ring); pose proof (Rabs_triang (- y) (- t)) end end end.
      rewrite !Rabs_Ropp in *. lra.
    - rewrite mult_IZR, plus_IZR, !real_norm. unfold e_a1, e_b. rewrite !real_minus.
      pose proof (norm_minus _ _ _ in2 in1) as A. pose proof (norm_minus _ _ _ (inW (next l)) (inW l)) as B. fold RR in A, B. lra.
    - intros K. pose proof (norm_m l K) as Nm. pose proof (norm_n K) as Nn.
      pose proof (norm_edge_b _ l F1) as Y1. pose proof (norm_edge_b _ l F2) as Y2. pose proof (norm_edge_a l) as Z0. pose proof (norm_edge_a (next l)) as Z1.
      assert (Fa : forall j, (norm (cross (minus (real (V2 x)) (real (V1 x))) (minus (real (W x j)) (real (V1 x)))) <=
        norm (cross (real (V1 x)) (real (V2 x))) + norm (cross (real (e_a1 x)) (real (W x j))))%R).
      { intros j. replace (cross (minus (real (V2 x)) (real (V1 x))) (minus (real (W x j)) (real (V1 x)))) with
          (plus (cross (real (V1 x)) (real (V2 x))) (cross (real (e_a1 x)) (real (W x j))))
          by (unfold e_a1; rewrite real_minus; unfold plus, cross, minus; cbn; f_equal; ring). apply norm_plus. }
      assert (Fb : forall v, (norm (cross (minus (real (W x (next l))) v) (minus (real (W x l)) v)) <=
        norm (cross (real (W x l)) (real (W x (next l)))) + norm (cross v (real (e_b x l))))%R).
      { intros v. rewrite (norm_opp_cross (minus (real (W x (next l))) v)), (norm_opp_cross v).
        replace (cross (minus (real (W x l)) v) (minus (real (W x (next l))) v)) with
          (plus (cross (real (W x l)) (real (W x (next l)))) (cross (real (e_b x l)) v))
          by (unfold e_b; rewrite real_minus; unfold plus, cross, minus; cbn; f_equal; ring). apply norm_plus. }
      pose proof (Fa l) as A. pose proof (Fa (next l)). rewrite norm_opp_cross in A. pose proof (Fb (real (V1 x))). pose proof (Fb (real (V2 x))).
      rewrite !plus_IZR, !mult_IZR. lra.
  Qed.

  (** The true fifteen, in the order of Table.v. *)
  Definition true_fifteen (v1 v2 w0 w1 w2 : vec) : list R :=
    let d10 := dot v1 (cross w0 w1) in let d11 := dot v1 (cross w1 w2) in let d12 := dot v1 (cross w2 w0) in
    let d20 := dot v2 (cross w0 w1) in let d21 := dot v2 (cross w1 w2) in let d22 := dot v2 (cross w2 w0) in
    let a0 := dot (cross v1 v2) w0 in let a1 := dot (cross v1 v2) w1 in let a2 := dot (cross v1 v2) w2 in
    let e := dot w0 (cross w1 w2) in
    [a0; a1; a2; e; (e - (d10 + d11 + d12))%R; (e - (d20 + d21 + d22))%R;
     (- d10)%R; (- d11)%R; (- d12)%R; (d10 - d20 + a0 - a1)%R; (d11 - d21 + a1 - a2)%R; (d12 - d22 + a2 - a0)%R; d20; d21; d22].

  Theorem errors : Forall2 (fun number true => near (fst number) (snd number) true)
    (combine (all_of (numbers x r)) (all_of (bounds k N s level x r))) (true_fifteen v1 v2 (w T0) (w T1) (w T2)).
  Proof.
    pose proof (plane_a_near T0) as A0. pose proof (plane_a_near T1) as A1. pose proof (plane_a_near T2) as A2. pose proof plane_b_0_near as B0.
    pose proof (corner_near _ _ F1 D1) as B1. pose proof (corner_near _ _ F2 D2) as B2.
    assert (S0 : forall l, near (- zdot (V1 x) (m r l)) _ _) by (intros l; exact (proj2 (end_near (V1 x) d1 l _ F1 D1 (or_intror eq_refl)) eq_refl)).
    assert (S2 : forall l, near (zdot (V2 x) (m r l)) _ _) by (intros l; exact (proj1 (end_near (V2 x) d2 l _ F2 D2 (or_introl eq_refl)) eq_refl)).
    pose proof (side_1_near T0) as C0. pose proof (side_1_near T1) as C1. pose proof (side_1_near T2) as C2.
    assert (T : forall C f t t', near C f t -> t = t' -> near C f t') by (intros; subst; auto).
    unfold all_of, to_list, true_fifteen. cbv zeta. cbn [app combine].
    repeat apply Forall2_cons; try apply Forall2_nil; cbn [fst snd];
      [exact A0|exact A1|exact A2|eapply T; [exact B0|]|eapply T; [exact B1|]|eapply T; [exact B2|]
        |eapply T; [exact (S0 T0)|]|eapply T; [exact (S0 T1)|]|eapply T; [exact (S0 T2)|]|eapply T; [exact C0|]|eapply T; [exact C1|]|eapply T; [exact C2|]
        |eapply T; [exact (S2 T0)|]|eapply T; [exact (S2 T1)|]|eapply T; [exact (S2 T2)|]];
      cbn [next]; fold v1 v2; generalize (w T0) (w T1) (w T2) v1 v2; intros [] [] [] [] []; unfold volume, dot, cross, minus; cbn; ring.
  Qed.
End Errors.

(** * Certain signs *)
(** 1, -1, or 0 where the sign is not certain. *)
Definition certain_sign (number bound : Z) : Z := if bound / 8 <? number then 1 else if number <? - (bound / 8) then -1 else 0.
Theorem sign_certain s number bound true : 0 <= s -> near s number bound true ->
  (certain_sign number bound = 1 -> (true > 0)%R) /\ (certain_sign number bound = -1 -> (true < 0)%R).
Proof.
  intros Hs K. unfold near in K. assert (PU : 0 < 2 ^ s) by (apply Z.pow_pos_nonneg; lia). apply IZR_lt in PU. set (U := IZR (2 ^ s)) in *.
  assert (B : bound < 8 * (bound / 8 + 1)) by (pose proof (Z.mul_succ_div_gt bound 8); lia).
  apply IZR_lt in B. rewrite mult_IZR, plus_IZR in B.
  assert (K' : (Rabs (IZR number * U - true) < (IZR (bound / 8) + 1) * U)%R) by nra. apply Rabs_def2 in K'.
  unfold certain_sign. split; intros H.
  - destruct (Z.ltb_spec (bound / 8) number) as [L|L]; [|destruct (number <? _); discriminate].
    assert (M : (IZR (bound / 8) + 1 <= IZR number)%R) by (rewrite <- plus_IZR; apply IZR_le; lia). nra.
  - destruct (Z.ltb_spec (bound / 8) number) as [L|L]; [discriminate|].
    destruct (Z.ltb_spec number (- (bound / 8))) as [M|M]; [|discriminate].
    assert (M' : (IZR number <= - (IZR (bound / 8) + 1))%R) by (rewrite <- plus_IZR, <- opp_IZR; apply IZR_le; lia). nra.
Qed.
