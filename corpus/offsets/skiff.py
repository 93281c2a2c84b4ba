#!/usr/bin/env python3
"""Writes skiff.csv, a fair skiff in feet-inches-eighths, and skiff.xlsx and skiff.ods with the
same cells (pip install openpyxl odfpy)."""

import csv

PLACES = [0, 24, 48, 72, 96, 120, 144]  # inches


def eighths(inches):
    n = round(inches * 16)
    feet, n = divmod(n, 192)
    whole, n = divmod(n, 16)
    return f"{feet}-{whole}-{n // 2}{'+' if n % 2 else ''}"


def lines(x):
    t = x / 144
    keel = 0.6 + 1.6 * (t - 0.4) ** 2 * 4 + 9 * max(0, t - 0.3) ** 4 - 0.6
    chine = (4.2 + 3.2 * t**3, 14.5 + 15.5 * t - 29.2 * t**2.6)
    sheer = (18.2 + 2.2 * (t - 0.25) ** 2 * 4 + 2.2 * t**3, 20.6 + 15 * t - 34.9 * t**2.2)
    return {"Sheer": sheer, "Chine": chine, "Keel": (keel, 0.0)}


def rows():
    at = [lines(x) for x in PLACES]
    yield ["Offsets in feet-inches-eighths to the outside of the planking"]
    yield ["Station"] + [f"Sta {n}" for n in range(len(PLACES))]
    yield ["Position"] + [eighths(x) for x in PLACES]
    yield []
    yield ["Heights above base"]
    for name in ("Sheer", "Chine", "Keel"):
        yield [name] + [eighths(line[name][0]) for line in at]
    yield []
    yield ["Half-breadths from centreline"]
    for name in ("Sheer", "Chine"):
        yield [name] + [eighths(line[name][1]) for line in at]


def main():
    cells = list(rows())
    with open("skiff.csv", "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(cells)

    import openpyxl

    book = openpyxl.Workbook()
    book.active.title = "Offsets"
    for row in cells:
        book.active.append(row)
    book.save("skiff.xlsx")

    from odf.opendocument import OpenDocumentSpreadsheet
    from odf.table import Table, TableCell, TableRow
    from odf.text import P

    book = OpenDocumentSpreadsheet()
    table = Table(name="Offsets")
    for row in cells:
        line = TableRow()
        for text in row:
            cell = TableCell(valuetype="string")
            cell.addElement(P(text=text))
            line.addElement(cell)
        table.addElement(line)
    book.spreadsheet.addElement(table)
    book.save("skiff.ods")


main()
