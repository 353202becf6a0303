"""Workbooks written by hand, part by part, as the standard (ECMA-376) has them."""

import io
import zipfile
from xml.sax.saxutils import escape

HEAD = '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n'
MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
PACKAGE = "http://schemas.openxmlformats.org/package/2006"
KIND = "application/vnd.openxmlformats-officedocument.spreadsheetml"
DATE, PERCENT = 1, 2  # styles of a cell


def number(text, style=0):
    """A cell with a number as it is stored."""
    return f'<c r="{{}}" s="{style}"><v>{text}</v></c>'


def text(content):
    """A cell with a text."""
    return f'<c r="{{}}" t="inlineStr"><is><t>{escape(content)}</t></is></c>'


def formula(code, value=None, kind=None):
    """A cell with a formula and the value stored with it, if there is one."""
    stored = "" if value is None else f"<v>{escape(value)}</v>"
    return f'<c r="{{}}"{f" t={kind!r}" if kind else ""}><f>{escape(code)}</f>{stored}</c>'


def of_type(kind, value):
    """A cell of another type: b for true and false, e for an error, str for a formula's text."""
    return f'<c r="{{}}" t="{kind}"><v>{escape(value)}</v></c>'


def sheet_xml(rows, *, hidden=(), merged=(), more=""):
    """The XML of a sheet: rows of cells as above, None for none; hidden rows by numbers from 1."""
    lines = []
    for k, row in enumerate(rows, 1):
        cells = "".join(
            cell.format(f"{chr(64 + j)}{k}") for j, cell in enumerate(row, 1) if cell is not None
        )
        mark = ' hidden="1"' if k in hidden else ""
        lines.append(f'<row r="{k}"{mark}>{cells}</row>')
    areas = "".join(f'<mergeCell ref="{area}"/>' for area in merged)
    areas = f"<mergeCells>{areas}</mergeCells>" if merged else ""
    data = f"<sheetData>{''.join(lines)}</sheetData>"
    return f'{HEAD}<worksheet xmlns="{MAIN}">{data}{areas}{more}</worksheet>'


def parts(sheets, states=()):
    """The parts of a workbook with these sheets, {name: XML}."""
    names = list(sheets)
    files = {f"xl/worksheets/sheet{k}.xml": sheets[name] for k, name in enumerate(names, 1)}
    files["xl/styles.xml"] = (
        f'{HEAD}<styleSheet xmlns="{MAIN}"><fonts count="1"><font/></fonts><fills count="1">'
        "<fill><patternFill/></fill></fills>"
        '<borders count="1"><border/></borders><cellStyleXfs count="1"><xf/></cellStyleXfs>'
        '<cellXfs count="3"><xf numFmtId="0"/><xf numFmtId="14" applyNumberFormat="1"/>'
        '<xf numFmtId="10"/></cellXfs></styleSheet>'
    )
    listed = "".join(
        f'<sheet name="{escape(name)}" sheetId="{k}" r:id="rId{k}"'
        + (f' state="{states[k - 1]}"' if states else "")
        + "/>"
        for k, name in enumerate(names, 1)
    )
    files["xl/workbook.xml"] = (
        f'{HEAD}<workbook xmlns="{MAIN}" xmlns:r="{OFFICE}"><sheets>{listed}</sheets></workbook>'
    )
    links = "".join(
        f'<Relationship Id="rId{k}" Type="{OFFICE}/worksheet" Target="worksheets/sheet{k}.xml"/>'
        for k in range(1, len(names) + 1)
    )
    links += f'<Relationship Id="rId0" Type="{OFFICE}/styles" Target="styles.xml"/>'
    files["xl/_rels/workbook.xml.rels"] = (
        f'{HEAD}<Relationships xmlns="{PACKAGE}/relationships">{links}</Relationships>'
    )
    files["_rels/.rels"] = (
        f'{HEAD}<Relationships xmlns="{PACKAGE}/relationships"><Relationship Id="rId1" '
        f'Type="{OFFICE}/officeDocument" Target="xl/workbook.xml"/></Relationships>'
    )
    overrides = "".join(
        f'<Override PartName="/xl/worksheets/sheet{k}.xml" ContentType="{KIND}.worksheet+xml"/>'
        for k in range(1, len(names) + 1)
    )
    files["[Content_Types].xml"] = (
        f'{HEAD}<Types xmlns="{PACKAGE}/content-types"><Default Extension="rels" '
        'ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
        '<Default Extension="xml" ContentType="application/xml"/>'
        f'<Override PartName="/xl/workbook.xml" ContentType="{KIND}.sheet.main+xml"/>'
        f'<Override PartName="/xl/styles.xml" ContentType="{KIND}.styles+xml"/>{overrides}</Types>'
    )
    return files


def packed(files, method=zipfile.ZIP_DEFLATED):
    """The archive of these parts, the same bytes whenever it is made."""
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", method) as archive:
        for name, content in files.items():
            info = zipfile.ZipInfo(name)
            info.compress_type = method
            archive.writestr(info, content)
    return made.getvalue()


def workbook(rows, **more):
    """A workbook of one sheet."""
    return packed(parts({"Tabelle1": sheet_xml(rows, **more)}))
