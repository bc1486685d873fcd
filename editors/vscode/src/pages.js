// SPDX-License-Identifier: Apache-2.0
// Pictures and pages of the launch command, in tabs of the editor: graphs, and the report on a trace.
'use strict';

const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');
const vscode = require('vscode');

// A picture alone runs no scripts; the page of a report is one file with its own, and loads nothing from elsewhere.
const PICTURE_POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'";
const PAGE_POLICY = "default-src 'none'; img-src data: blob:; style-src 'unsafe-inline'; script-src 'unsafe-inline' 'wasm-unsafe-eval'; font-src data:";

const pictureOf = (svg) => `<!DOCTYPE html><html><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${PICTURE_POLICY}">
<style>body { background: #fff; margin: 1em; } img { max-width: none; }</style></head>
<body><img alt="graph" src="data:image/svg+xml;base64,${Buffer.from(svg).toString('base64')}"></body></html>`;

const withPolicy = (html) =>
  html.replace(/<head>/i, `<head><meta http-equiv="Content-Security-Policy" content="${PAGE_POLICY}">`);

function showTab(title, html, enableScripts) {
  const panel = vscode.window.createWebviewPanel('launch.page', title, vscode.ViewColumn.Active,
                                                 { enableScripts, localResourceRoots: [], retainContextWhenHidden: true });
  panel.webview.html = html;
  return panel;
}

const firstLine = (text) => text.split('\n').find((line) => line !== '') || 'the launch command printed nothing';

// `words`: of `launch graph`, such as a file or `--live`.
async function showGraph(program, title, words) {
  const { code, output, errors } = await program.run(['graph', '--format', 'svg', ...words]);
  if (code !== 0 || !output.includes('<svg')) {
    vscode.window.showErrorMessage(firstLine(errors));
    return;
  }
  showTab(title, pictureOf(output), false);
}

async function showReport(program, directory) {
  const file = path.join(fs.mkdtempSync(path.join(os.tmpdir(), 'launch-report-')), 'report.html');
  try {
    const { errors } = await program.run(['report', directory, '--html', file]);
    // An incomplete trace has a page, too, and an exit code that says so.
    if (!fs.existsSync(file)) {
      vscode.window.showErrorMessage(firstLine(errors));
      return;
    }
    showTab(path.basename(directory), withPolicy(fs.readFileSync(file, 'utf8')), true);
  } finally {
    fs.rmSync(path.dirname(file), { recursive: true, force: true });
  }
}

module.exports = { showGraph, showReport, withPolicy };
