(** The stack of the collision engine never overflows: docs/engine.md, "The stack".

    With a capacity C and levels up to H, and W = C - 3 H - 1 at least 1: if a pair is popped only if used - 1 + 4 (flying + 1) <= W, or if
    none is in flight, then at most C - 1 entries are ever used: [stack_never_overflows]. *)
From Coq Require Import List Lia Arith.
Import ListNotations.

Section Stack.
  Variables H W : nat.
  Hypothesis Room : 1 <= W.

  (** Levels of the entries, the uppermost first, and of the pairs in flight. *)
  Definition state := (list nat * list nat)%type.
  Inductive step : state -> state -> Prop :=
  | wide l rest flight : length rest + 4 * (length flight + 1) <= W -> step (l :: rest, flight) (rest, flight ++ [l])
  | narrow l rest : step (l :: rest, []) (rest, [l])
  (** The answer of a pair: up to four entries of the next level, and none at the last level. *)
  | answer stack before l after n : n <= 4 -> (l < H \/ n = 0) -> step (stack, before ++ l :: after) (repeat (S l) n ++ stack, before ++ after).
  Inductive reached : state -> Prop :=
  | start : reached ([0], [])
  | more s t : reached s -> step s t -> reached t.

  (** With one pair in flight, depth first: what is above [base] are entries with few below each, for how deep they are. *)
  Definition shallow top := forall above l below, top = above ++ l :: below -> length below + 3 * (H - l) <= 3 * H.
  Definition wide_state (s : state) := length (fst s) + 4 * length (snd s) <= W.
  Definition deep_state (s : state) := exists top base, fst s = top ++ base /\ length base <= W - 1 /\ length top <= 3 * H + 1 /\ shallow top /\
    (snd s = [] \/ exists l, snd s = [l] /\ length top + 3 * (H - l) <= 3 * H).

  Lemma shallow_tail l top : shallow (l :: top) -> shallow top.
  Proof. intros Sh above k below ->. apply (Sh (l :: above) k below). reflexivity. Qed.
  Lemma shallow_push l top n : shallow top -> n <= 4 -> l < H -> length top + 3 * (H - l) <= 3 * H -> shallow (repeat (S l) n ++ top).
  Proof.
    intros Sh Hn Hl B. assert (G : n <= 4 -> shallow (repeat (S l) n ++ top)); [|auto]. clear Hn. induction n as [|n IH]; intros Hn; [exact Sh|].
    intros above k below E. destruct above as [|a above]; cbn in E; injection E as E1 E2.
    - subst. rewrite app_length, repeat_length. lia.
    - apply (IH ltac:(lia) above k below E2).
  Qed.

  Lemma step_keeps s t : wide_state s \/ deep_state s -> step s t -> wide_state t \/ deep_state t.
  Proof.
    intros I St. destruct St as [l rest flight Hw|l rest|stack before l after n Hn Hl].
    - left. unfold wide_state. cbn [fst snd]. rewrite app_length. cbn. lia.
    - right. destruct I as [I|(top & base & E & B & L & Sh & F)].
      + unfold wide_state in I. cbn in I. exists [], rest. repeat split; cbn; try lia.
        * intros above k below X. now destruct above.
        * right. exists l. split; [reflexivity|lia].
      + cbn in E. destruct top as [|a top].
        * cbn in E. subst base. cbn in B. exists [], rest. repeat split; cbn; try lia; auto. right. exists l. split; [reflexivity|lia].
        * cbn in E. injection E as -> ->. exists top, base. cbn in L. repeat split; cbn [fst snd]; try lia; auto; [now apply shallow_tail in Sh|].
          right. exists a. split; [reflexivity|]. apply (Sh [] a top eq_refl).
    - destruct I as [I|(top & base & E & B & L & Sh & [F|(k & F & D)])].
      + left. unfold wide_state in *. cbn [fst snd] in *. rewrite !app_length in *. rewrite repeat_length. cbn in I. lia.
      + cbn in F. now destruct before.
      + right. cbn in E, F. assert (X : before = [] /\ after = [] /\ l = k).
        { destruct before as [|b [|]]; cbn in F; [injection F as -> ->; auto| |]; discriminate. }
        destruct X as (-> & -> & ->). subst stack. exists (repeat (S k) n ++ top), base. cbn [fst snd app].
        destruct Hl as [Hl| ->]; [|cbn; repeat split; auto]. rewrite app_length, repeat_length.
        repeat split; auto; [now rewrite app_assoc|lia|now apply shallow_push].
  Qed.
  Theorem stack_never_overflows C s : W = C - 3 * H - 1 -> 3 * H + 2 <= C -> reached s -> length (fst s) < C.
  Proof.
    intros EW HC R. assert (I : wide_state s \/ deep_state s).
    { induction R as [|s t R IH St]; [left; unfold wide_state; cbn; lia|]. eapply step_keeps; eauto. }
    destruct I as [I|(top & base & E & B & L & _)]; [unfold wide_state in I; lia|]. rewrite E, app_length. lia.
  Qed.
End Stack.
