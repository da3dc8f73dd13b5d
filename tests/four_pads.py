"""A girder of 12 t on four pads at its corners, as a person describes it in a specimen.toml."""


def describe_four_pads(centre_height: str = "0.4 m", radius: str = "100 mm", more: str = "") -> str:
    """Give the text up to its pads, so that tables of buffers or storeys may follow.

    Args:
        centre_height: of the centre of gravity over the pads.
        radius: of a pad.
        more: lines of the specimen itself.
    """
    return f"""
mass = "12 t"
box = ["4 m", "3 m", "0.5 m"]
centre_height = "{centre_height}"
{more}
pad = {{ radius = "{radius}", stiffness = "200 kN/mm" }}
[pads]
A = {{ x = "1.8 m", y = "1.3 m" }}
B = {{ x = "-1.8 m", y = "1.3 m" }}
C = {{ x = "1.8 m", y = "-1.3 m" }}
D = {{ x = "-1.8 m", y = "-1.3 m" }}
"""
