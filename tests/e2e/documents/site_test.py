# SPDX-License-Identifier: Apache-2.0
"""The site of the documentation: each page is in the navigation, links and anchors lead somewhere, names of pages are links."""
import importlib.util
import os
import pathlib
import shutil
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ['SOURCE_DIRECTORY'])
specification = importlib.util.spec_from_file_location('build_site', SOURCE / 'docs/site/build_site.py')
build_site = importlib.util.module_from_spec(specification)
specification.loader.exec_module(build_site)


class PagesTest(unittest.TestCase):
    def test_each_page_is_in_the_navigation(self):
        with tempfile.TemporaryDirectory() as folder:
            names = build_site.write_pages(pathlib.Path(folder))
        build_site.check_navigation((SOURCE / 'docs/site/mkdocs.yml').read_text(), names)

    def test_a_page_that_the_navigation_lacks_is_named(self):
        with self.assertRaisesRegex(build_site.SiteError, '^docs/site/mkdocs.yml: the navigation lacks the page new.md$'):
            build_site.check_navigation('nav:\n  - old.md\n', {'old.md', 'new.md'})

    def test_names_of_pages_become_links_with_the_title(self):
        names, titles = {'docs/a.md': 'a.md', 'docs/b.md': 'b.md', 'README.md': 'index.md'}, {'docs/b.md': 'The second'}
        text = 'See `docs/b.md` and [the start](../README.md#top).\n```\n`docs/b.md`\n```\n'
        self.assertEqual(build_site.with_links(text, 'docs/a.md', names, titles),
                         'See [The second](b.md) and [the start](index.md#top).\n```\n`docs/b.md`\n```\n')

    def test_a_link_that_leads_nowhere_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            site = pathlib.Path(folder)
            (site / 'a.html').write_text('<h1 id="here"></h1><a href="#here"></a><a href="b.html"></a><a href="a.html#there"></a>')
            with self.assertRaises(build_site.SiteError) as caught:
                build_site.check_links(site)
        self.assertEqual(str(caught.exception), 'a.html: a.html#there names no place in that page\na.html: b.html leads to no file')


class SiteTest(unittest.TestCase):
    def test_the_site_is_built_and_its_links_hold(self):
        missing = [program for program in ('mkdocs', 'doxygen') if not shutil.which(program)]
        if missing:
            self.skipTest(f'skipped, because {" and ".join(missing)} is not installed (./dev docs installs it)')
        with tempfile.TemporaryDirectory() as folder:
            build_site.build(pathlib.Path(folder))
            self.assertIn('The first five minutes', (pathlib.Path(folder) / 'site/index.html').read_text())
            self.assertTrue((pathlib.Path(folder) / 'site/cpp/classlaunch__trace_1_1Reader.html').exists())


if __name__ == '__main__':
    unittest.main()
