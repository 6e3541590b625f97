"""Links that leave docs/ lead to files of the repository, which the site does not have: the site shows their path instead."""
import re


def on_page_markdown(markdown, page, **_):
    return re.sub(r"\[([^\]]*)\]\((?:\.\./)+([^)]+)\)", r"\1 (`\2`)", markdown)
