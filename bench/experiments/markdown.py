"""Tables and pictures of docs/experiments.md."""
import os

from plan import ROOT

PICTURES = os.path.join(ROOT, "docs", "pictures", "experiments")


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]) + "\n"


def save(name, text):
    os.makedirs(PICTURES, exist_ok=True)
    with open(os.path.join(PICTURES, name), "w", encoding="utf-8") as file:
        file.write(text)
