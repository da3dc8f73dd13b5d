"""The style sheet of every report: the colours of the pictures, one column, wide enough for figures."""

from slipwise.view.colours import (
    GRID,
    INK,
    MUTED,
    NIGHT,
    NIGHT_GRID,
    NIGHT_INK,
    NIGHT_MUTED,
    PAD_COLOURS,
    PAPER,
    UPLIFT,
)

_GOOD, _WARN, _BAD = "#00795c", "#b26a00", UPLIFT
#: The same on a dark ground; figures stay on paper there.
_NIGHT_BLUE, _NIGHT_GOOD, _NIGHT_WARN, _NIGHT_BAD = PAD_COLOURS["C"], "#3fc79f", PAD_COLOURS["D"], "#ff6fa5"

#: Custom properties by which every page has its colours, on paper and on a dark ground.
LIGHT = (
    f"--ink: {INK}; --muted: {MUTED}; --line: {GRID}; --paper: {PAPER}; --blue: {PAD_COLOURS['A']}; "
    f"--good: {_GOOD}; --warn: {_WARN}; --bad: {_BAD}; --soft: #f5f7f9;"
)
DARK = (
    f"--ink: {NIGHT_INK}; --muted: {NIGHT_MUTED}; --line: {NIGHT_GRID}; --paper: {NIGHT}; --blue: {_NIGHT_BLUE}; "
    f"--good: {_NIGHT_GOOD}; --warn: {_NIGHT_WARN}; --bad: {_NIGHT_BAD}; --soft: #1a2027; color-scheme: dark;"
)

STYLE = f"""
:root {{ {LIGHT} }}
* {{ box-sizing: border-box; }}
html {{ -webkit-text-size-adjust: 100%; scroll-behavior: smooth; }}
body {{ margin: 0; background: var(--paper); color: var(--ink);
  font: 16px/1.6 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", "DejaVu Sans", sans-serif; }}
header {{ border-bottom: 4px solid var(--blue); background: var(--soft); padding: 1rem 1.25rem 1.2rem; }}
header > div, main {{ max-width: 68rem; margin: 0 auto; }}
header > div {{ padding: 0 1.25rem; }}
main {{ padding: 1.25rem; }}
.brand {{ color: var(--blue); font-weight: 700; letter-spacing: .08em; text-transform: uppercase; font-size: .8rem; }}
h1 {{ font-size: clamp(1.5rem, 4.5vw, 2.1rem); line-height: 1.2; margin: .2rem 0 0; overflow-wrap: anywhere; }}
h2 {{ font-size: 1.35rem; line-height: 1.3; margin: 2.6rem 0 .8rem; padding-top: .7rem;
  border-top: 1px solid var(--line); overflow-wrap: anywhere; }}
p, ul {{ max-width: 46rem; margin: .7rem 0; overflow-wrap: anywhere; }}
a {{ color: var(--blue); }}
code {{ background: var(--soft); border-radius: 4px; padding: .1em .35em; font-size: .9em;
  font-family: ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; }}
nav ol {{ columns: 2 16rem; column-gap: 2rem; padding: .9rem 1rem .9rem 2.4rem; margin: 1.4rem 0;
  background: var(--soft); border-radius: 8px; max-width: none; }}
nav li {{ break-inside: avoid; padding: .12rem 0; }}
nav a {{ text-decoration: none; }} nav a:hover {{ text-decoration: underline; }}
figure {{ margin: 1.4rem 0; }}
figure img, figure svg {{ display: block; width: 100%; height: auto; }}
.narrow {{ display: none; }}
figcaption {{ color: var(--muted); font-size: .92rem; margin-top: .5rem; max-width: 46rem; }}
.scroll {{ overflow-x: auto; margin: 1.2rem 0; }}
table {{ border-collapse: collapse; font-size: .95rem; font-variant-numeric: tabular-nums; }}
caption {{ text-align: left; font-weight: 600; padding-bottom: .4rem; }}
th {{ text-align: left; color: var(--muted); font-weight: 600; border-bottom: 2px solid var(--line); }}
th, td {{ padding: .4rem .9rem .4rem .2rem; vertical-align: top; }}
td {{ border-bottom: 1px solid var(--line); }}
.number {{ text-align: right; white-space: nowrap; }}
tr.marked td {{ background: #fff6e0; font-weight: 600; }}
.verdict {{ border: 1px solid var(--line); border-left: 8px solid var(--tone); border-radius: 8px;
  padding: 1rem 1.25rem; margin: 1.2rem 0; background: var(--soft); }}
.verdict p {{ margin: .2rem 0; }}
.verdict .headline {{ font-size: 1.3rem; font-weight: 700; line-height: 1.3; color: var(--tone); }}
.verdict dl {{ display: flex; flex-wrap: wrap; gap: .3rem 2rem; margin: .8rem 0 0; }}
dt {{ color: var(--muted); font-size: .85rem; }} dd {{ margin: 0; font-weight: 700; font-size: 1.1rem; }}
aside {{ border-left: 4px solid var(--tone); padding: .5rem 1rem; margin: 1.2rem 0; background: var(--soft);
  border-radius: 0 8px 8px 0; max-width: 46rem; }}
aside strong {{ color: var(--tone); }}
.plain {{ --tone: var(--blue); }} .good {{ --tone: var(--good); }} .warn {{ --tone: var(--warn); }}
.bad {{ --tone: var(--bad); }}
details {{ border: 1px solid var(--line); border-radius: 8px; padding: .6rem 1rem; margin: 1rem 0; }}
summary {{ cursor: pointer; font-weight: 600; }}
@media screen and (prefers-color-scheme: dark) {{
  :root {{ {DARK} }}
  tr.marked td {{ background: #3a3015; }}
  figure svg, figure img {{ border-radius: 8px; background: {PAPER}; }} }}
@media screen and (max-width: 40rem) {{
  main {{ padding: 1rem; }} header, header > div {{ padding-left: .5rem; padding-right: .5rem; }}
  figure .picture {{ overflow-x: auto; }} figure .picture svg {{ min-width: 40rem; }}
  figure .wide {{ display: none; }} figure .narrow {{ display: block; }}
  nav ol {{ columns: 1; }} }}
@media print {{
  @page {{ size: A4; margin: 14mm 13mm; }}
  body {{ font-size: 9.5pt; line-height: 1.4; }} header, nav ol, .verdict, aside {{ background: none; }}
  header, main {{ padding-left: 0; padding-right: 0; }} header > div, main {{ max-width: none; padding: 0; }}
  nav {{ display: none; }} a {{ color: inherit; text-decoration: none; }}
  h2 {{ font-size: 13pt; margin: 1.2rem 0 .4rem; break-after: avoid; }} p, ul, aside, figcaption {{ max-width: none; }}
  figure {{ margin: .6rem 0; }} figure, .verdict, aside, tr {{ break-inside: avoid; }}
  figure svg, figure img {{ max-height: 105mm; }}
  .scroll {{ overflow: visible; margin: .6rem 0; }} table {{ font-size: 7.5pt; max-width: 100%; }}
  th, td {{ padding: .12rem .5rem .12rem .1rem; overflow-wrap: anywhere; }}
  details {{ border: 0; padding: 0; }}
  details > *:not(summary) {{ display: block; }} details::details-content {{ content-visibility: visible; }} }}
"""
