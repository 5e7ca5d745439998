#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""loop_mix_test.py: tools/loop_mix.py finds the path around a loop and the kinds of its instructions. Each check has a
negative control."""
import unittest

import tool  # noqa: F401 (makes tools importable)

import loop_mix

# A loop that begins at 0x14. The official scene takes the path through 0x20. The path through 0x18 has no reciprocal,
# and the path through 0x30 is longer.
CODE = [
    (0x10, "vmovaps %zmm1,%zmm2"),
    (0x14, "vfmadd213ps %zmm1,%zmm2,%zmm3{%k1}"),
    (0x15, "je 30"),
    (0x16, "jne 20"),
    (0x18, "jmp 14"),
    (0x20, "vrcp14ps %zmm1,%zmm2"),
    (0x24, "vaddps %zmm1,%zmm2,%zmm3"),
    (0x28, "jmp 14"),
    (0x30, "vrcp14ps %zmm1,%zmm2"),
    (0x34, "vmulps %zmm1,%zmm2,%zmm3"),
    (0x38, "vmulps %zmm1,%zmm2,%zmm3"),
    (0x3c, "vmulps %zmm1,%zmm2,%zmm3"),
    (0x40, "jmp 14"),
    (0x44, "ret"),
]


class LoopMixTest(unittest.TestCase):
    def test_the_shortest_way_that_has_the_marks(self) -> None:
        way = loop_mix.loop(CODE, {"vrcp14": 1})
        self.assertEqual([text.split()[0] for text in way], ["vfmadd213ps", "je", "jne", "vrcp14ps", "vaddps", "jmp"])
        self.assertEqual(len(loop_mix.loop(CODE, {})), 4)  # if no instruction is required, a shorter path is found
        longer = loop_mix.loop(CODE, {"vrcp14": 1, "vmulp": 3})
        self.assertEqual(sum(text.startswith("vmulps") for text in longer), 3)

    def test_the_loop_with_the_marks_is_read_not_the_first(self):
        two = [
            (0x0, "vfmadd213ps %zmm1,%zmm2,%zmm3{%k1}"), (0x6, "vmulps %zmm1,%zmm2,%zmm3"), (0xC, "jne    0 <f>"),
            (0x10, "vfmadd213ps %zmm1,%zmm2,%zmm3{%k1}"), (0x16, "vrcp14ps %zmm1,%zmm2"), (0x1C, "jmp    10 <f+0x10>"),
        ]
        self.assertEqual(loop_mix.loop(two, {"vrcp14": 1}), [text for _, text in two[3:]])
        self.assertEqual(loop_mix.loop(two, {"vmulp": 1}), [text for _, text in two[:3]])

    def test_no_such_way(self) -> None:
        for marks in ({"vrsqrt14": 1}, {"vdivp": 1}):
            with self.assertRaises(SystemExit):
                loop_mix.loop(CODE, marks)
        with self.assertRaises(SystemExit):
            loop_mix.loop([code for code in CODE if not code[1].startswith("vfmadd")], {})

    def test_kinds(self) -> None:
        kinds = loop_mix.mix(
            [
                "vfnmadd132ps %zmm1,%zmm2,%zmm3",
                "vaddps %zmm1,%zmm2,%zmm3",
                "vmulps (%rax),%zmm2,%zmm3{%k2}",
                "vmovaps %zmm1,%zmm2",  # uses no arithmetic port
                "vmovaps %zmm1,%zmm2{%k3}",
                "vcmplt_oqps %zmm1,%zmm2,%k0{%k1}",
                "vrangeps $0x2,%zmm1,%zmm2,%zmm3",
                "kortestw %k1,%k2",
                "cmp %eax,%ebx",
            ]
        )
        self.assertEqual(
            {name: n for name, n in kinds.items() if n},
            {
                "multiply-add": 1,
                "sum": 1,
                "product": 1,
                "choice": 1,
                "comparison": 1,
                "smaller, larger, clip, sign": 1,
                "mask": 1,
            },
        )


if __name__ == "__main__":
    unittest.main()
