/* SPDX-License-Identifier: MIT */
/* Root hand-over: offers, acceptances, offers that wait too long, heirs and roots that die meanwhile. */
#ifndef OFFERS
#define OFFERS 2
#endif
#ifndef LATES
#define LATES 1
#endif
#ifndef ADVANCES
#define ADVANCES 2
#endif
#define CLAIMS 0
#include "token.pml"
