"""Models in the text format of older Simulink (.mdl)."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.python.wecsim_files import TWO_BODIES, TWO_BODY_INPUT, TWO_BODY_LINES, write_slx

from hydrodae.errors import CaseError
from hydrodae.wecsim import convert
from hydrodae.wecsim.mdl import read_mdl
from hydrodae.wecsim.slx import Model, read_slx

LIBRARIES = {
    "Rigid Body": "WECSim_Lib/Body Elements/Rigid Body",
    "Global Reference Frame": "WECSim_Lib/Frames/Global Reference Frame",
    "Floating (3DOF)": "WECSim_Lib/Constraints/Floating (3DOF)",
    "Translational PTO": "WECSim_Lib/PTOs/Translational\\nPTO",
}
#: A subsystem with a signal, and a MATLAB function whose text goes on over lines.
CONTROLLER = r"""
    Block {
      BlockType               SubSystem
      Name                    "Control"
      Ports                   [0, 1]
      Position                [10, 20,
                               30, 40]
      System {
        Name                    "Control"
        Block {
          BlockType               Gain
          Name                    "Twice"
          Gain                    "2"
        }
        Block {
          BlockType               SubSystem
          Name                    "Law"
          SFBlockType             "MATLAB Function"
          System {
            Block {
              BlockType               Inport
              Name                    "u"
            }
          }
        }
        Block {
          BlockType               Outport
          Name                    "Force"
        }
        Line {
          SrcBlock                "Twice"
          SrcPort                 1
          Branch {
            DstBlock                "Law"
            DstPort                 1
          }
          Branch {
            Points                  [0, 5]
            Branch {
              DstBlock                "Force"
              DstPort                 1
            }
          }
        }
      }
    }
    Block {
      BlockType               SubSystem
      Name                    "Copy"
      Object {
        $PropName               "MaskObject"
        Array {
          Type                    "Simulink.MaskParameter"
          Object {
            Name                    "body"
            Value                   "body(3)"
          }
        }
      }
      System {
        Block {
          BlockType               PMIOPort
          Name                    "F"
          Side                    "Right"
        }
      }
    }
    Block {
      BlockType               Scope
      Name                    "Seen"
    }
    Line {
      SrcBlock                "Control"
      SrcPort                 1
      DstBlock                "Seen"
      DstPort                 1
    }
"""
STATEFLOW = r"""# Finite State Machines
Stateflow {
  chart {
    id                      7
    name                    "Control/Law"
  }
  state {
    chart                   7
    eml {
      script                  "function y = law(u)\n"
      "y = \"2\\n\" * u;"
    }
  }
}
"""


def write_mdl(path: Path, extra: str = "", after: str = "") -> None:
    """The model of two bodies; its lines name blocks, and one of them branches."""
    text = 'Model {\n  Version\t8.6\n  SavedCharacterEncoding  "ISO-8859-1"\n  System {\n'
    for name, kind, parameter in TWO_BODIES:
        mask = parameter.partition("(")[0]
        text += f'Block {{\nBlockType\tReference\nName\t"{name}"\nSourceBlock "{LIBRARIES[kind]}"\n'
        text += f'{mask}\t"{parameter}"\n}}\n'
    for line in TWO_BODY_LINES:
        first, *others = line.split("-")
        text += f'Line {{\nLineType "Connection"\n{end("Src", first)}'
        text += "".join(f"Branch {{\n{end('Dst', other)}}}\n" for other in others) + "}\n"
    path.write_text(text + extra + "  }\n}\n" + after, encoding="latin-1")


def end(which: str, text: str) -> str:
    name = TWO_BODIES[int(text[:-1]) - 1][0]
    return f'{which}Block\t"{name}"\n{which}Port {text[-1].upper()}Conn1\n'


def nets(model: Model) -> set[frozenset[tuple[str, str]]]:
    ends = [(net, block.name, port) for block in model.blocks for port, net in block.nets.items()]
    return {frozenset(e[1:] for e in ends if e[0] == net) for net, _, _ in ends}


def test_the_same_blocks_and_nets_as_in_an_archive(tmp_path: Path) -> None:
    write_mdl(tmp_path / "model.mdl")
    write_slx(tmp_path / "model.slx", TWO_BODIES, TWO_BODY_LINES)
    text, archive = read_mdl(tmp_path / "model.mdl"), read_slx(tmp_path / "model.slx")
    assert [(b.name, b.kind) for b in text.blocks] == [(b.name, b.kind) for b in archive.blocks]
    assert nets(text) == nets(archive)
    assert len(nets(text)) == 3
    assert text.blocks[0].parameters["body"] == "body(1)"


def test_signals_masks_and_functions(tmp_path: Path) -> None:
    write_mdl(tmp_path / "model.mdl", CONTROLLER, STATEFLOW)
    blocks = {block.name: block for block in read_mdl(tmp_path / "model.mdl").blocks}
    law = blocks["Control/Law"]
    assert law.parameters["script"] == 'function y = law(u)\ny = "2\\n" * u;'
    assert law.parameters["inputs"] == "u"
    for name in ("Control/Law", "Seen"):
        driver, port = blocks[name].drivers["in:1"]
        assert (driver.name, driver.parameters["Gain"], port) == ("Control/Twice", "2", "out:1")
    assert (blocks["Copy"].kind, blocks["Copy"].ports) == ("Rigid Body", {"F": "rconn:1"})


@pytest.mark.parametrize("stated", ["model.mdl", "model", ".slx"])
def test_a_folder_with_such_a_model_is_converted(
    two_bodies: Path, tmp_path: Path, stated: str
) -> None:
    case = convert(two_bodies, tmp_path / "slx").case.read_text()
    (two_bodies / "model.slx").unlink()
    write_mdl(two_bodies / "model.mdl")
    text = TWO_BODY_INPUT.replace("'model.slx'", f"'{stated}'")
    (two_bodies / "wecSimInputFile.m").write_text(text)
    found = convert(two_bodies, tmp_path / "mdl").case.read_text()
    assert found == case.replace("model.slx", "model.mdl")


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ('Model {\n  Name "a\n', ":2: a string that does not end"),
        ("Model {\n  System {\n", ":2: System { is not closed"),
        ("Model {\n}\n}\n", ":3: cannot be read as a line of an .mdl file"),
        ("Model {\n  Name\n}\n", ":2: cannot be read as a line of an .mdl file"),
        ("Model {\n  A [1, 2\n", ":1: Model { is not closed"),
        ("A {\n" * 300, ":201: cannot be read"),
        ("A {\n}\n", ": there is no model in this file"),
        (
            'Model {\nSystem {\nLine {\nSrcBlock "a"\n}\n}\n}\n',
            ":3: SrcBlock: this system has no block 'a'",
        ),
        ("# MathWorks OPC Text Package\n__MWOPC_PACKAGE_BEGIN__ R2022a\n", ": an .mdl file that"),
        ('SavedCharacterEncoding "no-such"\n', ": no .mdl file of Simulink"),
    ],
)
def test_what_cannot_be_read_is_one_error(tmp_path: Path, text: str, why: str) -> None:
    path = tmp_path / "model.mdl"
    path.write_text(text)
    with pytest.raises(CaseError) as error:
        read_mdl(path)
    assert f"model.mdl{why}" in str(error.value)
