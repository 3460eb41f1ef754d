/* SPDX-License-Identifier: MIT */
/* The order of the tree: nobody takes a parent that is not ahead, and no chain of parents closes.
   Every robot may at any time take any parent that is ahead, leave, join an edge, hand on the token;
   what it hears of another is any of that robot's last values. The rules of the algorithms only choose
   among these steps. docs/proofs.md has the rest. */
#include "swarm.pml"

#ifndef COUNTS
#define COUNTS 2   /* times that roots count, in an epoch */
#endif
#ifndef EPOCHS
#define EPOCHS 0   /* epochs that open on the way */
#endif
#ifndef HANDOVERS
#define HANDOVERS 1
#endif
#ifndef LABELS
#define LABELS 4   /* labels from the root's to the largest that can be sent */
#endif

/* What a robot may do. */
#define TAKE_PARENT 1
#define FOLLOW 2
#define TAKE_LABEL 3
#define JOIN_EDGE 4
#define LEAVE 5
#define COUNT 6
#define TAKE_TOKEN 7
#define LISTEN 8
#define OPEN_EPOCH 9

c_decl {
\#include "rules.h"
\#include "sizes.h"
#define COUNT_AT_FIRST 65535  /* so that it wraps */
#define LARGEST 65534
#define UNKNOWN 65535
#define HEARD(k, copy) ((copy) == 0 ? &now.robot[k] : &now.older[k][(copy) - 1])
};
c_state "struct Order robot[ROBOTS]" "Global"
c_state "struct Order older[ROBOTS][COPIES]" "Global"

byte act, me, from, copy, cm;  /* the next step; 0 between steps */
bool cycle, behind;
byte counts_left = COUNTS, epochs_left = EPOCHS, handovers_left = HANDOVERS;

c_code {
  /* Robot `me` becomes `next`: what it was can still be heard. */
  static void become(struct Order next) {
    struct Order* old = &now.robot[now.me];
    if (memcmp(&next, old, sizeof next) == 0) return;
    if (next.epoch != old->epoch) {
      next.seqno = COUNT_AT_FIRST;
      if (next.root) next.label = LARGEST - LABELS;
    }
    for (int k = COPIES - 1; k > 0; --k) now.older[now.me][k] = now.older[now.me][k - 1];
    now.older[now.me][0] = *old;
    *old = next;
    Printf("robot %d: epoch %d seqno %d label %d parent %d%s\n", now.me, next.epoch, next.seqno, next.label, next.parent,
           next.root ? " root" : "");
  }

  static int closes(int k) {
    int at = now.robot[k].parent;
    for (int steps = 0; at != nobody_id && steps <= ROBOTS; ++steps) at = now.robot[at].parent;
    return at != nobody_id;
  }

  /* Whom I hang on is ahead of me, as of now. Nobody may be hung on any more at the largest label; but who is
     there already may still be fresher. */
  static int is_behind_parent(int k) {
    const struct Order* r = &now.robot[k];
    if (r->parent == nobody_id || now.robot[r->parent].epoch != r->epoch) return 1;
    struct Order parent = now.robot[r->parent];
    if (parent.label == LARGEST && parent.seqno != r->seqno) --parent.label;
    return order_is_ahead(k, r, r->parent, &parent);
  }

  static void take_step(void) {
    const int me = now.me, from = now.from;
    struct Order r = now.robot[me];
    const struct Order* heard = HEARD(from, now.copy);
    switch (now.act) {
      case TAKE_PARENT:
        if (r.root || !order_is_ahead(me, &r, from, heard)) break;
        order_take_parent(me, &r, from, heard, now.cm);
        break;
      case FOLLOW:
        if (!r.root && (r.parent == from || r.parent == nobody_id)) order_update(me, &r, from, heard, now.cm);
        break;
      case TAKE_LABEL:
        if (!r.root && r.label == UNKNOWN) order_take_label(me, &r, from, heard, now.cm);
        break;
      case JOIN_EDGE:  /* of `from`; its parent was heard as it is, or as it was (cm) */
        if (!r.root && r.parent == nobody_id && heard->parent != nobody_id && heard->parent != me)
          order_join_edge(me, &r, from, heard, heard->parent, HEARD(heard->parent, now.cm - 1));
        break;
      case LEAVE:
        order_leave(me, &r);
        break;
      case COUNT:
        if (!r.root || now.counts_left == 0) return;
        --now.counts_left;
        order_update(me, &r, nobody_id, 0, 0);
        break;
      case TAKE_TOKEN:  /* `from` is root from now on, and hangs on nobody */
        if (!now.robot[from].root || now.handovers_left == 0) return;
        --now.handovers_left;
        now.robot[from].root = 0;
        r.root = 1;
        r.parent = nobody_id;
        break;
      case LISTEN:
        order_listen(me, &r, from, heard);
        break;
      case OPEN_EPOCH:
        if (!r.root || now.epochs_left == 0) return;
        --now.epochs_left;
        now.counts_left = COUNTS;
        order_open_epoch(me, &r);
        break;
    }
    become(r);
    for (int k = 0; k < ROBOTS; ++k) {
      if (closes(k)) now.cycle = 1;
      if (!is_behind_parent(k)) now.behind = 1;
    }
  }
};

active proctype swarm() {
  c_code {
    for (int k = 0; k < ROBOTS; ++k) {
      now.robot[k] = (struct Order){.epoch = 65535, .seqno = COUNT_AT_FIRST, .label = UNKNOWN, .parent = nobody_id, .root = 0};
      if (k == 0) now.robot[k].root = 1, now.robot[k].label = LARGEST - LABELS;
      for (int c = 0; c < COPIES; ++c) now.older[k][c] = now.robot[k];
    }
  };
  do
  :: atomic {
    choose(me);
    if
    :: choose_other(from); choose_copy(copy);
       if :: cm = 1 :: cm = 2 fi;
       if
       :: act = TAKE_PARENT
       :: act = FOLLOW
       :: act = TAKE_LABEL
       :: act = JOIN_EDGE
       fi
    :: choose_other(from); act = TAKE_TOKEN
#if EPOCHS > 0
    :: choose_other(from); choose_copy(copy); act = LISTEN
#endif
    :: act = LEAVE
    :: act = COUNT
#if EPOCHS > 0
    :: act = OPEN_EPOCH
#endif
    fi;
    c_code { take_step(); };
    assert(!cycle);
    assert(!behind);
    act = 0; me = 0; from = 0; copy = 0; cm = 0
  }
  od
}
