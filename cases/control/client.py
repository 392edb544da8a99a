"""The PI controller of case.toml as another program, for case_tcp.toml with protocol "hydrodae".

python client.py & hydrodae-solve case_tcp.toml -o results.h5 --set controller.pi.protocol=hydrodae
"""

import sys

from hydrodae import tcp

GAIN_P, GAIN_I = 600.0, 300.0  # N s/m, N/m


def main(port: int) -> None:
    """Answer until the run ends."""
    integral = 0.0
    with tcp.connect(port=port) as run:
        assert isinstance(run, tcp.Numbered)
        period = run.hello["period"]
        for _, (rate,) in run:
            error = -rate
            run.answer(GAIN_P * error + integral)
            integral += period * GAIN_I * error


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 50000)
