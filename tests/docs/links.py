#!/usr/bin/env python3
"""Whether every link within a site leads to a file, and to a place in it: links.py SITE."""

import html.parser
import pathlib
import sys
import urllib.parse


class Read(html.parser.HTMLParser):
    """The links of a page, and the places that links may lead to."""

    def __init__(self, page):
        super().__init__()
        self.links, self.places = set(), {""}
        self.feed(page.read_text())

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src") and value:
                self.links.add(value)
            elif name in ("id", "name") and value:
                self.places.add(value)


def broken(site):
    """Pages and their links that lead nowhere. Reports, which stand alone, are only led to."""
    pages = {page.resolve(): Read(page) for page in site.rglob("*.html") if page.parent != site / "reports"}
    for page, read in pages.items():
        for link in sorted(read.links):
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            to = (page.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else page
            if not to.exists():
                yield page, link
            elif to in pages and urllib.parse.unquote(parts.fragment) not in pages[to].places:
                yield page, link


def main():
    site = pathlib.Path(sys.argv[1])
    found = list(broken(site))
    for page, link in found:
        print(f"{page.relative_to(site.resolve())}: {link} leads nowhere")
    if found or not (site / "index.html").exists():
        sys.exit(f"{len(found)} links lead nowhere")
    print("all links lead somewhere")


if __name__ == "__main__":
    main()
