# SPDX-License-Identifier: MIT
"""Where the firmware's bytes are: a table by room. A byte belongs to the innermost room that its line was inlined
from, so what `core/` and the standard library do for a room counts as that room's.

    rooms.py FIRMWARE.elf
"""
import collections
import subprocess
import sys


def output(tool, *arguments, text=None):
    return subprocess.run([f"arm-none-eabi-{tool}", *arguments], input=text, capture_output=True, text=True, check=True).stdout


def addresses(elf):
    """Every second address within functions: an instruction has at least two bytes."""
    for line in output("nm", "-S", elf).splitlines():
        parts = line.split()
        if len(parts) == 4 and parts[2] in "tTwW":
            start = int(parts[0], 16) & ~1
            yield from range(start, start + int(parts[1], 16), 2)


def room(chain):
    """`chain`: the source files of an instruction, from the innermost to the function that it is in."""
    folders = [part for path in chain if "controller/" in path for part in [path.rsplit("controller/", 1)[1]]]
    folders = [path.removeprefix("src/").split("/")[0] if "/" in path.removeprefix("src/") else "steps" for path in folders]
    own = [folder for folder in folders if folder not in ("core", "steps")]
    return (own or folders or ["library and start"])[0]


def main(elf):
    found = [hex(a) for a in sorted(set(addresses(elf)))]  # two names may be of one function
    chains = []
    for line in output("addr2line", "-a", "-i", "-e", elf, text="\n".join(found)).splitlines():
        if line.startswith("0x"):
            chains.append([])
        else:
            chains[-1].append(line)
    sizes = collections.Counter()
    for chain in chains:
        sizes[room(chain)] += 2
    print("| room | bytes |\n| --- | --- |")
    for name, size in sizes.most_common():
        print(f"| {name} | {size:,} |")


main(sys.argv[1])
