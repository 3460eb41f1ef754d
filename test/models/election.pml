/* SPDX-License-Identifier: MIT */
/* Election: the root dies, or is only silent for long, and one or several claim to be root. */
#define OFFERS 0
#define LATES 0
#ifndef CLAIMS
#define CLAIMS 2
#endif
#ifndef ADVANCES
#define ADVANCES 2
#endif
#include "token.pml"
