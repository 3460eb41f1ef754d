# SPDX-License-Identifier: MIT
# A controller of your own, in Python: it deploys 32 robots to four targets 3 m away, and their network stays whole.
import numpy as np

import banyan


class Foam(banyan.Controller):
    """Robots spread like foam around those that are sent to targets, and nobody goes where the foam is thin."""

    def reset(self, robot):
        self.robot = robot

    def step(self, seen):
        ahead = seen.positions
        distance = np.hypot(*ahead.T).clip(0.01)
        if seen.target is not None:  # a worker goes on while neighbours follow
            near = np.sort(distance)[:2]
            way = seen.target * 0.4 if len(near) == 2 and near[1] < 1.3 else np.zeros(2)
        else:  # away from those nearer than a metre, back to those that are far
            way = -(ahead / distance[:, None] * np.clip(1.05 - distance, 0, None)[:, None]).sum(axis=0)
            nearest = np.argsort(distance)[:3]
            way += (ahead[nearest] * np.clip(distance[nearest] - 1.2, 0, None)[:, None]).sum(axis=0)
        push = 0.3 * (ahead / distance[:, None] ** 2 * np.clip(0.3 - distance, 0, None)[:, None]).sum(axis=0)
        return self.robot.drive(0.3 * way - push)


if __name__ == "__main__":
    for name, mine in (("foam", dict(controller=Foam)), ("convoy", dict(algorithm="convoy"))):
        result = banyan.run("scenarios/paper-small.toml", **mine)
        end = f"complete after {result['completion_time_s']:.1f} s" if result.complete else "not complete"
        print(f"{name}: {end}, {result['split_ticks']} ticks in several parts")
