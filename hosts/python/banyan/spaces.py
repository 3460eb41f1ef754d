# SPDX-License-Identifier: MIT
"""Spaces of actions and observations with the names that Gymnasium's users expect, without Gymnasium."""

from __future__ import annotations

from typing import Any

import numpy as np


class Box:
    """Arrays of one shape, each number between its `low` and its `high`."""

    def __init__(self, low: Any, high: Any, shape: tuple[int, ...] | None = None, dtype: Any = np.float32) -> None:
        self.shape = tuple(shape) if shape is not None else np.broadcast_shapes(np.shape(low), np.shape(high))
        self.dtype = np.dtype(dtype)
        self.low = np.broadcast_to(np.asarray(low, self.dtype), self.shape)
        self.high = np.broadcast_to(np.asarray(high, self.dtype), self.shape)
        self._random = np.random.default_rng()

    def seed(self, seed: int | None = None) -> None:
        self._random = np.random.default_rng(seed)

    def sample(self) -> np.ndarray:
        """Uniform; without bounds, normal."""
        bounded = np.isfinite(self.low) & np.isfinite(self.high)
        low, high = np.where(bounded, self.low, 0), np.where(bounded, self.high, 0)
        values = np.where(bounded, self._random.uniform(low, high, self.shape), self._random.normal(size=self.shape))
        return values.astype(self.dtype)

    def contains(self, x: Any) -> bool:
        array = np.asarray(x)
        return array.shape == self.shape and bool(
            np.can_cast(array.dtype, self.dtype, "same_kind") and ((array >= self.low) & (array <= self.high)).all()
        )

    __contains__ = contains

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Box)
            and self.shape == other.shape
            and self.dtype == other.dtype
            and np.array_equal(self.low, other.low)
            and np.array_equal(self.high, other.high)
        )

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"Box({self.low.min(initial=np.inf)}, {self.high.max(initial=-np.inf)}, {self.shape}, {self.dtype})"
