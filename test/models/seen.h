/* SPDX-License-Identifier: MIT */
/* What comes of a state if nothing more goes wrong is looked at once per state, not once per step that leads there: a
   table of the digests of those seen. One that is pushed out by another is only looked at again. */
#pragma once

static int seen(unsigned long long graph, const void* bytes, int size) {
  static unsigned long long table[1 << 20];
  unsigned long long digest = 14695981039346656037ULL ^ graph << 32;
  for (int k = 0; k < size; ++k) digest = (digest ^ ((const unsigned char*)bytes)[k]) * 1099511628211ULL;
  digest ^= digest >> 29;
  unsigned long long* entry = &table[digest & ((1 << 20) - 1)];
  if (*entry == digest) return 1;
  *entry = digest;
  return 0;
}
