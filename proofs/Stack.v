(** The stacks and queues of the collision engine, with any number of queries in flight: docs/engine.md, "The stack".

    With a capacity C, levels up to H, and W = C - 3 H - 1 at least 1: if a pair is popped only if used - 1 + 4 (flying + 1) <= W, or if
    none of its query is in flight, then at most C - 1 entries of a query are ever used ([stack_never_overflows]). A queue of leaf pairs
    holds at most Q, and a younger query, which pops only if queued + 4 (flying + 1) < Q, never fills its own; so every pair in flight
    goes on, though leaf pairs wait while any queue is full, unless the oldest query has some to be tested first ([never_stuck]). Whatever the order of all this is, a query
    whose stack, flights and queue are empty has sent each of its leaf pairs once ([all_are_sent]), so none that touches is lost
    ([no_query_loses_a_pair]). *)
From Coq Require Import List Lia Arith Bool Permutation.
Require Import Efsat.Hierarchy.
Import ListNotations.

Section Stack.
  (** Pairs of nodes; the [offspring] of one are the pairs of children that are not apart. Leaf pairs are sent, others pushed. *)
  Variable pair : Type.
  Variables (level : pair -> nat) (is_leaf : pair -> bool) (offspring leaves : pair -> list pair).
  Variables H W Q F : nat.
  Hypothesis Room : 1 <= W.
  Hypothesis Some_flight : 1 <= F.
  Hypothesis Some_queue : 1 <= Q.
  Hypothesis Few : forall p, length (offspring p) <= 4.
  Hypothesis Deeper : forall p q, In q (offspring p) -> is_leaf q = false -> level q = S (level p) /\ level p < H.
  (** The leaf pairs below a pair. *)
  Hypothesis Leaves : forall p, leaves p = if is_leaf p then [p] else flat_map leaves (offspring p).

  (** A query: its stack, the uppermost first; its pairs in flight, each with the survivors that are still to come; its leaf pairs that
      wait, and those that the triangle unit has got. *)
  Record lane := Lane { root : pair; stack : list pair; flight : list (pair * list pair); queue : list pair; sent : list pair }.
  Definition coming (l : lane) : list pair := flat_map snd (flight l).
  (** What a query does if [flying] pairs of all queries are in flight. *)
  Inductive moves (oldest : bool) (flying : nat) : lane -> lane -> Prop :=
  | pop r p rest f q s : flying < F -> length rest + 4 * (length f + 1) <= W \/ f = [] -> oldest = true \/ length q + 4 * (length f + 1) < Q ->
      moves oldest flying (Lane r (p :: rest) f q s) (Lane r rest (f ++ [(p, offspring p)]) q s)
  | push r st before p x more after q s : is_leaf x = false ->
      moves oldest flying (Lane r st (before ++ (p, x :: more) :: after) q s) (Lane r (x :: st) (before ++ (p, more) :: after) q s)
  | send r st before p x more after q s : is_leaf x = true -> length q < Q ->
      moves oldest flying (Lane r st (before ++ (p, x :: more) :: after) q s) (Lane r st (before ++ (p, more) :: after) (q ++ [x]) s)
  | finish r st before p after q s : moves oldest flying (Lane r st (before ++ (p, []) :: after) q s) (Lane r st (before ++ after) q s)
  | test r st f x q s : oldest = true -> moves oldest flying (Lane r st f (x :: q) s) (Lane r st f q (s ++ [x])).
  (** All queries, the oldest first. One starts behind the others; the oldest ends, done or not. *)
  Inductive step : list lane -> list lane -> Prop :=
  | start p all : is_leaf p = false -> step all (all ++ [Lane p [p] [] [] []])
  | one before l l' after : moves (match before with [] => true | _ => false end) (length (flat_map flight (before ++ l :: after))) l l' ->
      step (before ++ l :: after) (before ++ l' :: after)
  | ends l all : step (l :: all) all.
  Inductive reached : list lane -> Prop :=
  | none : reached []
  | more s t : reached s -> step s t -> reached t.

  (** ** What holds of every query *)
  Definition in_order (l : lane) := Forall (fun f => length (snd f) <= 4 /\ incl (snd f) (offspring (fst f))) (flight l) /\ Forall (fun p => is_leaf p = false) (stack l).
  (** Many pairs in flight, but with places for all that comes; or one at a time, depth first: above [base] are entries with few below
      each, for how deep they are. *)
  Definition wide (l : lane) := length (stack l) + length (coming l) <= W.
  Definition shallow (top : list pair) := forall above p below, top = above ++ p :: below -> length below + 3 * (H - level p) <= 3 * H.
  Definition deep (l : lane) := exists top base, stack l = top ++ base /\ length base <= W - 1 /\ length top <= 3 * H + 1 /\ shallow top /\
    (flight l = [] \/ exists p more, flight l = [(p, more)] /\ length top + length more + 3 * (H - level p) <= 3 * H + 4).
  Definition complete (l : lane) := Permutation (sent l ++ queue l ++ flat_map leaves (coming l ++ stack l)) (leaves (root l)).
  Definition good (l : lane) := in_order l /\ (wide l \/ deep l) /\ length (queue l) <= Q /\ complete l.
  Definition has_room (l : lane) := length (queue l) + length (coming l) < Q.

  Lemma coming_at before p xs after : flat_map snd (before ++ (p, xs) :: after) = flat_map (@snd pair (list pair)) before ++ xs ++ flat_map snd after.
  Proof. now rewrite flat_map_app. Qed.
  Lemma coming_few f : Forall (fun f : pair * list pair => length (snd f) <= 4 /\ incl (snd f) (offspring (fst f))) f -> length (flat_map snd f) <= 4 * length f.
  Proof. induction 1 as [|x f [A _] _ IH]; cbn; [lia|]. rewrite app_length. lia. Qed.
  Lemma shallow_tail p top : shallow (p :: top) -> shallow top.
  Proof. intros Sh above q below ->. apply (Sh (p :: above) q below). reflexivity. Qed.
  Lemma shallow_push p top : shallow top -> length top + 3 * (H - level p) <= 3 * H -> shallow (p :: top).
  Proof. intros Sh B above q below E. destruct above as [|a above]; cbn in E; injection E as E1 E2; [subst; exact B|]. exact (Sh above q below E2). Qed.
  Lemma alone {A} before (x y : A) after : before ++ x :: after = [y] -> before = [] /\ after = [] /\ x = y.
  Proof. destruct before as [|b [|]]; cbn; intros [=]; auto. Qed.

  Lemma order_kept o n l l' : moves o n l l' -> in_order l -> in_order l'.
  Proof.
    unfold in_order. intros M [A B]. destruct M; cbn [flight stack] in *.
    - inversion B; subst. split; auto. apply Forall_app. split; auto. constructor; [|constructor]. cbn. split; [apply Few|apply incl_refl].
    - apply Forall_app in A as [A1 A2]. inversion A2 as [|? ? [A3 A4] A5]; subst. cbn in A3, A4. apply incl_cons_inv in A4 as [A4 A6].
      split; [|now constructor]. apply Forall_app. split; auto. constructor; auto. cbn. split; [lia|auto].
    - apply Forall_app in A as [A1 A2]. inversion A2 as [|? ? [A3 A4] A5]; subst. cbn in A3, A4. apply incl_cons_inv in A4 as [A4 A6].
      split; auto. apply Forall_app. split; auto. constructor; auto. cbn. split; [lia|auto].
    - apply Forall_app in A as [A1 A2]. inversion A2; subst. split; auto. now apply Forall_app.
    - auto.
  Qed.

  Lemma stack_kept o n l l' : moves o n l l' -> in_order l -> wide l \/ deep l -> wide l' \/ deep l'.
  Proof.
    unfold in_order. intros M [A B] I. destruct M as [r p rest f q s _ G _|r st before p x more after q s X|r st before p x more after q s X _|r st before p after q s|r st f x q s _];
      cbn [flight stack] in A, B.
    - destruct G as [G| ->].
      + left. unfold wide, coming. cbn [flight stack]. rewrite flat_map_app, app_length. cbn. rewrite app_nil_r.
        pose proof (coming_few _ A). pose proof (Few p). lia.
      + right. pose proof (Few p) as L. unfold deep. cbn [flight stack app]. destruct I as [I|(top & base & E & Lb & Lt & Sh & _)].
        * unfold wide in I. cbn in I. exists [], rest. repeat split; cbn; try lia.
          -- intros above k below E. now destruct above.
          -- right. exists p, (offspring p). split; [reflexivity|lia].
        * cbn [stack] in E. destruct top as [|a top]; cbn in E.
          -- subst base. cbn in Lb. exists [], rest. repeat split; cbn; try lia; auto. right. exists p, (offspring p). split; [reflexivity|lia].
          -- injection E as -> ->. cbn in Lt. exists top, base. repeat split; try lia; auto; [now apply shallow_tail in Sh|].
             right. exists a, (offspring a). split; [reflexivity|]. pose proof (Sh [] a top eq_refl). lia.
    - destruct I as [I|(top & base & E & Lb & Lt & Sh & [I|(k & rest & I & D)])]; cbn [flight stack] in *.
      + left. unfold wide, coming in *. cbn [flight stack] in *. rewrite coming_at, !app_length in *. cbn in *. lia.
      + now destruct before.
      + right. apply alone in I as (-> & -> & [= <- <-]). cbn [length] in D.
        apply Forall_inv in A as [_ A]. cbn in A. destruct (Deeper p x (A x (in_eq _ _)) X) as [Lx Lp].
        exists (x :: top), base. cbn [flight stack app]. subst st. repeat split; auto; cbn [length]; [lia|apply shallow_push; auto; lia|].
        right. exists p, more. split; [reflexivity|lia].
    - destruct I as [I|(top & base & E & Lb & Lt & Sh & [I|(k & rest & I & D)])]; cbn [flight stack] in *.
      + left. unfold wide, coming in *. cbn [flight stack] in *. rewrite coming_at, !app_length in *. cbn in *. lia.
      + now destruct before.
      + right. apply alone in I as (-> & -> & [= <- <-]). cbn [length] in D. exists top, base. cbn [flight stack app].
        repeat split; auto. right. exists p, more. split; [reflexivity|lia].
    - destruct I as [I|(top & base & E & Lb & Lt & Sh & [I|(k & rest & I & D)])]; cbn [flight stack] in *.
      + left. unfold wide, coming in *. cbn [flight stack] in *. rewrite coming_at in I. now rewrite flat_map_app.
      + now destruct before.
      + right. apply alone in I as (-> & -> & _). exists top, base. repeat split; auto.
    - exact I.
  Qed.

  Lemma queue_kept o n l l' : moves o n l l' -> length (queue l) <= Q -> length (queue l') <= Q.
  Proof. destruct 1; cbn; rewrite ?app_length; cbn; lia. Qed.
  Lemma room_kept n l l' : moves false n l l' -> in_order l -> has_room l -> has_room l'.
  Proof.
    unfold in_order, has_room, coming. intros M [A _] R. destruct M as [r p rest f q s _ _ [G|G]| | | |]; cbn [flight queue] in *; try discriminate.
    - rewrite flat_map_app, app_length. cbn. rewrite app_nil_r. pose proof (coming_few _ A). pose proof (Few p). lia.
    - rewrite coming_at, !app_length in *. cbn in R. lia.
    - rewrite coming_at, !app_length in *. cbn in *. lia.
    - rewrite coming_at in R. now rewrite flat_map_app.
  Qed.

  Lemma complete_kept o n l l' : moves o n l l' -> in_order l -> complete l -> complete l'.
  Proof.
    unfold complete, in_order, coming. intros M [_ B] P. destruct M as [r p rest f q s _ _ _|r st before p x more after q s X|r st before p x more after q s X _|r st before p after q s|r st f x q s _];
      cbn [flight stack queue sent root] in *; eapply Permutation_trans; try exact P; rewrite ?coming_at, ?flat_map_app; cbn [flat_map snd app];
      rewrite ?app_nil_r, ?flat_map_app; cbn [flat_map]; rewrite <- ?app_assoc; repeat apply Permutation_app_head.
    - apply Forall_inv in B. now rewrite (Leaves p), B.
    - rewrite (app_assoc (flat_map leaves more)), Permutation_app_swap_app, <- app_assoc. reflexivity.
    - rewrite (Leaves x), X. cbn [app]. rewrite (Permutation_middle (flat_map leaves (flat_map snd before))). reflexivity.
    - reflexivity.
    - reflexivity.
  Qed.

  Lemma move_keeps o n l l' : moves o n l l' -> good l -> good l'.
  Proof.
    intros M (A & B & C & D).
    split; [eapply order_kept; eauto|]. split; [eapply stack_kept; eauto|]. split; [eapply queue_kept; eauto|eapply complete_kept; eauto].
  Qed.
  Lemma all_good s : reached s -> Forall good s /\ Forall has_room (tl s).
  Proof.
    induction 1 as [|s t _ [G R] St]; [split; constructor|]. destruct St as [p all L|before l l' after M|l all].
    - split.
      + apply Forall_app. split; auto. constructor; [|constructor]. split; [split; cbn; auto|]. split; [left; unfold wide; cbn; lia|].
        split; [cbn; lia|]. unfold complete. cbn. now rewrite app_nil_r.
      + destruct all as [|l all]; cbn in *; [constructor|]. apply Forall_app. split; auto.
    - apply Forall_app in G as [Gb Ga]. inversion Ga as [|? ? Gl Ga']; subst. split.
      + apply Forall_app. split; auto. constructor; auto. eapply move_keeps; eauto.
      + destruct before as [|b before]; cbn in *; auto. apply Forall_app in R as [Rb Ra]. inversion Ra; subst.
        apply Forall_app. split; auto. constructor; auto. eapply room_kept; eauto. apply Gl.
    - inversion G; subst. split; auto. destruct all; cbn in *; auto. now inversion R.
  Qed.

  Theorem stack_never_overflows C s l : W = C - 3 * H - 1 -> 3 * H + 2 <= C -> reached s -> In l s -> length (stack l) < C /\ length (queue l) <= Q.
  Proof.
    intros EW HC R I. apply all_good in R as [G _]. rewrite Forall_forall in G. destruct (G l I) as (_ & J & K & _). split; auto.
    destruct J as [J|(top & base & E & B & L & _)]; [unfold wide in J; lia|]. rewrite E, app_length. lia.
  Qed.

  Definition done (l : lane) := stack l = [] /\ flight l = [] /\ queue l = [].
  Theorem all_are_sent s l : reached s -> In l s -> done l -> Permutation (sent l) (leaves (root l)).
  Proof.
    intros R I (A & B & C). apply all_good in R as [G _]. rewrite Forall_forall in G. destruct (G l I) as (_ & _ & _ & D).
    unfold complete, coming in D. rewrite A, B, C in D. cbn in D. now rewrite app_nil_r in D.
  Qed.

  (** A pair in flight goes on, if its next survivor finds a place: while a queue is full, no leaf pair comes into any. *)
  Definition goes_on (s : list lane) (f : pair * list pair) := forall x more, snd f = x :: more -> is_leaf x = true -> forall k, In k s -> length (queue k) < Q.
  Theorem never_stuck l rest : reached (l :: rest) -> let flights := flat_map flight (l :: rest) in
    done l \/ queue l <> [] \/ flights <> [] /\ (forall k f, In k (l :: rest) -> In f (flight k) -> goes_on (l :: rest) f) \/
    flights = [] /\ exists l', moves true (length flights) l l'.
  Proof.
    intros R flights. apply all_good in R as [G Y]. cbn [tl] in Y.
    destruct (queue l) as [|x q] eqn:E; [|right; left; discriminate]. destruct flights as [|f fs] eqn:Ef.
    - unfold flights in Ef. cbn in Ef. apply app_eq_nil in Ef as [Ef _].
      destruct l as [r [|p st] f q s]; cbn in *; subst; [left; repeat split|]. right; right; right. split; auto.
      exists (Lane r st ([] ++ [(p, offspring p)]) [] s). apply pop; auto.
    - right; right; left. split; [discriminate|]. intros _ _ _ _ _ _ _ _ k [<-|I]; [rewrite E; cbn; lia|].
      rewrite Forall_forall in Y. specialize (Y k I). unfold has_room in Y. lia.
  Qed.
End Stack.

(** The two trees of [no_pair_is_lost]: a pair of nodes, and how many levels are left for it. *)
Arguments Leaf {volume triangle}.
Arguments Node {volume triangle}.
Section Trees.
  Variables volume_a volume_b triangle_a triangle_b : Type.
  Variable are_apart : volume_a -> volume_b -> bool.
  Variable H : nat.
  Definition nodes := (nat * tree volume_a triangle_a * tree volume_b triangle_b)%type.
  Definition level (p : nodes) := H - fst (fst p).
  Definition is_leaf (p : nodes) := match p with (_, Leaf _ _, Leaf _ _) => true | _ => false end.
  Definition each {A} (f : nat -> tree volume_a triangle_a -> tree volume_b triangle_b -> list A) rest m n :=
    flat_map (fun c => flat_map (fun d => if are_apart (top c) (top d) then [] else f rest c d) (children n)) (children m).
  Definition offspring (p : nodes) : list nodes :=
    match p with
    | (_, Leaf _ _, Leaf _ _) | (0, _, _) => []
    | (S rest, m, n) => if rest <? H then each (fun rest c d => [(rest, c, d)]) rest m n else []
    end.
  Fixpoint below (rest : nat) (m : tree volume_a triangle_a) (n : tree volume_b triangle_b) : list nodes :=
    match m, n, rest with
    | Leaf _ _, Leaf _ _, _ => [(rest, m, n)]
    | _, _, 0 => []
    | _, _, S rest => if rest <? H then each below rest m n else []
    end.
  Definition leaves (p : nodes) := let '(rest, m, n) := p in below rest m n.
  Definition triangles_of (p : nodes) := match p with (_, Leaf _ x, Leaf _ y) => [(x, y)] | _ => [] end.

  Lemma flat_map_flat_map {A B C} (g : B -> list C) (f : A -> list B) xs : flat_map g (flat_map f xs) = flat_map (fun x => flat_map g (f x)) xs.
  Proof. induction xs as [|x xs IH]; cbn; auto. now rewrite flat_map_app, IH. Qed.
  Lemma each_then {A B} (g : A -> list B) f rest m n : flat_map g (each f rest m n) = each (fun rest c d => flat_map g (f rest c d)) rest m n.
  Proof.
    unfold each. rewrite flat_map_flat_map. apply flat_map_ext. intros c. rewrite flat_map_flat_map. apply flat_map_ext. intros d.
    now destruct (are_apart _ _).
  Qed.
  Lemma each_ext {A} (f g : nat -> _ -> _ -> list A) rest m n : (forall c d, f rest c d = g rest c d) -> each f rest m n = each g rest m n.
  Proof. intros E. unfold each. apply flat_map_ext. intros c. apply flat_map_ext. intros d. now rewrite E. Qed.
  Lemma leaves_open p : leaves p = if is_leaf p then [p] else flat_map leaves (offspring p).
  Proof.
    destruct p as [[[|rest] m] n]; [destruct m, n; reflexivity|].
    assert (G : (if rest <? H then each below rest m n else []) = flat_map leaves (if rest <? H then each (fun rest c d => [(rest, c, d)]) rest m n else [])).
    { destruct (rest <? H); auto. rewrite each_then. apply each_ext. intros c d. cbn. now rewrite app_nil_r. }
    destruct m, n; first [reflexivity|exact G].
  Qed.
  Lemma few p : length (offspring p) <= 4.
  Proof.
    destruct p as [[[|rest] m] n]; [destruct m, n; cbn; lia|].
    destruct m, n; cbn -[Nat.ltb]; try lia; destruct (rest <? H); cbn; try lia; repeat match goal with |- context [are_apart ?v ?w] => destruct (are_apart v w) end; cbn; lia.
  Qed.
  Lemma in_each (p : nodes) rest m n : In p (each (fun rest c d => [(rest, c, d)]) rest m n) -> fst (fst p) = rest.
  Proof.
    unfold each. rewrite in_flat_map. intros (c & _ & I). rewrite in_flat_map in I. destruct I as (d & _ & I).
    destruct (are_apart _ _); [destruct I|destruct I as [<-|[]]; reflexivity].
  Qed.
  Lemma deeper p q : In q (offspring p) -> is_leaf q = false -> level q = S (level p) /\ level p < H.
  Proof.
    intros I _. destruct p as [[[|rest] m] n]; [destruct m, n; destruct I|].
    assert (J : rest < H /\ fst (fst q) = rest).
    { destruct m, n; cbn [offspring] in I; try (now destruct I); destruct (Nat.ltb_spec rest H) as [K|K]; try (now destruct I); split; auto; now apply in_each in I. }
    unfold level. destruct J as [K ->]. cbn. lia.
  Qed.
  Lemma leaves_are_pairs rest m n : rest <= H -> flat_map triangles_of (below rest m n) = leaf_pairs _ _ _ _ are_apart rest m n.
  Proof.
    revert m n. induction rest as [|rest IH]; intros m n L; [destruct m, n; reflexivity|].
    assert (G : flat_map triangles_of (if rest <? H then each below rest m n else []) = each (leaf_pairs _ _ _ _ are_apart) rest m n).
    { destruct (Nat.ltb_spec rest H); [|lia]. rewrite each_then. apply each_ext. intros c d. apply IH. lia. }
    destruct m, n; first [reflexivity|exact G].
  Qed.

  Variable holds_a : volume_a -> triangle_a -> Prop. Variable holds_b : volume_b -> triangle_b -> Prop.
  Variable touch : triangle_a -> triangle_b -> Prop.
  Hypothesis Test : forall v w x y, holds_a v x -> holds_b w y -> touch x y -> are_apart v w = false.
  Theorem no_query_loses_a_pair W Q F s l m n x y : 1 <= W -> 1 <= F -> 1 <= Q -> reached nodes is_leaf offspring W Q F s -> In l s -> done nodes l ->
    root nodes l = (H, m, n) -> height m <= H -> height n <= H -> bounded holds_a m -> bounded holds_b n ->
    In x (triangles m) -> In y (triangles n) -> touch x y -> In (x, y) (flat_map triangles_of (sent nodes l)).
  Proof.
    intros HW HF HQ R I D E Hm Hn Bm Bn Ix Iy T.
    assert (P : Permutation (sent nodes l) (leaves (root nodes l))) by (eapply (all_are_sent nodes level is_leaf offspring leaves H W Q F); eauto using few, deeper, leaves_open).
    rewrite E in P. eapply Permutation_in; [apply Permutation_sym, Permutation_flat_map, P|]. cbn. rewrite leaves_are_pairs by lia.
    eapply no_pair_is_lost; eauto.
  Qed.
End Trees.
