# SPDX-License-Identifier: MIT
"""`python -m banyan` is the program `banyan`."""

from __future__ import annotations

from banyan_program import become

from .places import program

if __name__ == "__main__":
    become(program())
