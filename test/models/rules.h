/* SPDX-License-Identifier: MIT */
/* The controller's own rules, as the Spin models (*.pml) call them: each function puts one robot on a
   bench, with what the model lets it remember and hear, calls the controller, and reads back what the
   model keeps. Nothing is decided here. */
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

enum { nobody_id = -1, largest_swarm = 8 };

/* order.pml: a robot's place in the order of the tree, as it knows and sends it. */
struct Order {
  unsigned short epoch, seqno, label;
  signed char parent;
  unsigned char root; /* holds the token */
};

int order_is_ahead(int me, const struct Order* self, int id, const struct Order* heard);
/* The range to `id` is `cm`. */
void order_take_parent(int me, struct Order* self, int id, const struct Order* heard, int cm);
void order_leave(int me, struct Order* self);
/* What a step does about the order where no parent is chosen: a root counts, a robot with a parent follows
   it, a free spare follows whom it hears. `id` -1: nobody is heard. */
void order_update(int me, struct Order* self, int id, const struct Order* heard, int cm);
void order_take_label(int me, struct Order* self, int id, const struct Order* heard, int cm);
/* A spare whose request `owner` has granted joins the edge to `above`, the owner's parent. */
void order_join_edge(int me, struct Order* self, int owner, const struct Order* owned, int above, const struct Order* over);
/* Hears of epochs; takes part in a newer one. */
void order_listen(int me, struct Order* self, int id, const struct Order* heard);
/* A root opens the next epoch. */
void order_open_epoch(int me, struct Order* self);

/* token.pml: who is root, as a robot knows and sends it. */
struct Token {
  unsigned short epoch, sequence;
  signed char root, new_root; /* whom the token is offered to */
  unsigned char phase, size, worker, dead;
};
enum { start_tree = 1, grow_tree = 3, select_root_phase = 4 };

int token_is_root(int me, const struct Token* self);
/* Hears of tokens, epochs and offers; a smaller fragment's root yields. */
void token_hear(int me, struct Token* self, int id, const struct Token* heard);
/* SELECT ROOT at the root: `heir` is nearer to the centroid, -1: nobody is. `late`: the offer has waited too long. */
void token_select_root(int me, struct Token* self, int heir, const struct Token* heard, int late);
/* The root has been silent for long, and was near. */
void token_claim(int me, struct Token* self);
/* The root counts `robots` and opens the next phases up to GROW TREE; in GROW TREE it opens SELECT ROOT. */
void token_advance(int me, struct Token* self, int robots);

/* takeover.pml: who serves the one task, as a robot knows and sends it. */
struct Service {
  unsigned short beat;
  signed char holder;
  unsigned char known, serving, dead;
};
/* One step of `beats` ticks: counts if it serves, hears `heard` if `id` is not -1. `silent`: the holder has not been heard of
   for longer than its successor waits. */
void service_step(int me, struct Service* self, int id, const struct Service* heard, int beats, int silent);
int service_ahead_by(unsigned short a, unsigned short b);

/* epochs.pml: where a robot stands in an epoch. */
struct Stage {
  unsigned short epoch, label;
  unsigned char phase, flood_done, flood_workers, subtree_workers, committed, worker, dead;
  signed char flood_parent, parent, old_parent;
};
/* One step of the tree's rooms as inwards and convoy call them, in which all of `heard` are heard; `patient`: a robot
   without label waits for nearer ones; `late`: the root's barrier has waited for too long. */
void stage_step(int me, struct Stage* self, const struct Stage* const* heard, const int* from, int count, int patient, int late);
/* GROW TREE has lasted for R: SELECT ROOT, and since nobody is nearer the next epoch. */
void stage_open_epoch(int me, struct Stage* self);

/* insertion.pml: an edge's owner, or a spare. */
struct Insertion {
  unsigned char need, spare_state, role, dead;
  signed char parent, grant, request, inserted_child;
  unsigned char grant_ticks, request_ticks, ungranted_ticks, inserted_ticks;
};
/* One step of `ticks` ticks in which all of `heard` are heard. `stretched`: the edge to my parent needs a spare; `may_insert`: a spare
   that has been granted an edge is where it can join it. */
void insertion_step(int me, struct Insertion* self, const struct Insertion* const* heard, const int* from, int count, int stretched, int may_insert,
                    int ticks);

#ifdef __cplusplus
}
#endif
