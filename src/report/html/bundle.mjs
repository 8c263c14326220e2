// SPDX-License-Identifier: AGPL-3.0-or-later
// Bundles vtk_view.js with what it uses of vtk.js into one script: node bundle.mjs SOURCE OUT, run where npm ci was.
// The licences of all packages that go in stand at its head, as they ask for.

import {build} from 'esbuild';
import {existsSync, readdirSync, readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';

const [source, out] = process.argv.slice(2);
const modules = join(process.cwd(), 'node_modules');
const result = await build({
  entryPoints: [source], bundle: true, minify: true, format: 'iife', globalName: 'GeomendVtkView', target: 'es2020', charset: 'ascii',
  legalComments: 'none', nodePaths: [modules], metafile: true, write: false, logLevel: 'error', define: {'process.env.NODE_ENV': '"production"'}});

const packages = new Set();
for (const input of Object.keys(result.metafile.inputs)) {
  const match = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input);
  if (match) packages.add(match[1]);
}

function licenceOf(name) {
  const folder = join(modules, name), about = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
  const file = existsSync(folder) && readdirSync(folder).find((entry) => /^(licen[sc]e|copying)(\.|$)/i.test(entry));
  const text = file ? readFileSync(join(folder, file), 'utf8').trim() : `Licence: ${about.license}`;
  return `${name} ${about.version}\n\n${text}`;
}
const banner = [...packages].sort().map(licenceOf).join('\n\n----\n\n').replaceAll('*/', '* /').replace(/[^\x00-\x7f]/g, '?');
writeFileSync(out, `/*!\nThis script holds, in this form or another:\n\n${banner}\n*/\n${result.outputFiles[0].text}`);
