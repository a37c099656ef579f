"""Tables of Markdown pages: which cells are the tool's, and what they say."""

import math
import re

MARK = re.compile(r"<!-- table: (\S+) -->\n\n((?:\|.*\n)+)")  # above a table
NUMBER = r"-?[\d,]+(?:\.\d+)?"
OTHERS = re.compile(r"DEM|discrete elements|prototype|experiments|reference|before: |D/d$")  # rows and columns that are the page's own
CELL = re.compile(rf"(?P<mean>{NUMBER})(?: ± (?P<deviation>{NUMBER})| of (?P<all>\d+))?(?: \({NUMBER} to {NUMBER}\))?")


def rows_of(table):
    """Cells of a Markdown table by row, the titles of columns first."""
    rows = [[cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip())[1:-1]] for line in table.splitlines()]
    return rows[:1] + rows[2:]


def table_of(rows):
    lines = ["|" + "".join(f" {cell} |" if cell else " |" for cell in row) for row in rows]
    return "\n".join([lines[0], "|" + "---|" * len(rows[0]), *lines[1:], ""])


def tables_in(text):
    """By name the rows of all that have a mark."""
    return {mark[1]: rows_of(mark[2]) for mark in MARK.finditer(text)}


def places(rows, table):
    """Of the tool's cells: row and column of the tool, and where they are in rows."""
    for y, (title, *_) in enumerate(rows):
        for x, head in enumerate(rows[0]):
            for row in table.rows:
                for column in table.columns:
                    if y and x and (title, head) == (row.title, column.title):
                        yield row, column, y, x


def written(text, table, cells):
    """The page with what these cells, by the titles of row and column, say. What is not the tool's stays."""
    def filled(mark):
        if mark[1] != table.name:
            return mark[0]
        rows = rows_of(mark[2])
        for row, column, y, x in places(rows, table):
            rows[y][x] = cells[row.title, column.title].text
        return f"<!-- table: {table.name} -->\n\n{table_of(rows)}"
    return MARK.sub(filled, text)


def faults_of_form(text, page, tables):
    """Where marks, titles and numbers of a page are not as those tables have them. Tables of other pages do not count."""
    found, told = tables_in(text), {table.name: table for table in tables if table.page == page}
    for name in sorted(found.keys() ^ told.keys()):
        yield f"{page}, {name}: " + ("no such table in bench/document_tables" if name in found else "no mark above a table of the page")
    for name in sorted(found.keys() & told.keys()):
        rows, table = found[name], told[name]
        for what, here, there in (("row", [row[0] for row in rows[1:]], table.rows), ("column", rows[0][1:], table.columns)):
            here, there = [title for title in here if not OTHERS.search(title)], [line.title for line in there]
            if here != there:
                yield f"{page}, {name}: titles of {what}s are {here} in the page, {there} in bench/document_tables"
        for row, column, y, x in places(rows, table):
            if len(rows[y]) != len(rows[0]):
                yield f"{page}, {name}: row '{row.title}' has {len(rows[y])} cells of {len(rows[0])}"
            elif rows[y][x] and not CELL.fullmatch(rows[y][x]):
                yield f"{page}, {name}: '{rows[y][x]}' of '{row.title}', '{column.title}' is no number with or without its scatter"


def agrees(said, cell, seeds):
    """Whether a page and a cell differ by four standard errors of their difference at most, and a unit of the page's last digit. `seeds`: how many the
    number of the page is of."""
    if not said or not cell.text:
        return said == cell.text
    parts = CELL.fullmatch(said)
    mean, *deviation = (float(part.replace(",", "")) for part in parts.group("mean", "deviation") if part)
    unit = 10.0 ** -len(parts["mean"].partition(".")[2])
    if parts["all"]:
        mean, unit = mean / int(parts["all"]), 0
    scatter = deviation[0] if deviation else cell.deviation
    return abs(mean - cell.mean) <= 4 * math.sqrt(scatter**2 / (1 if cell.count == 1 else seeds) + cell.deviation**2 / cell.count) + unit
