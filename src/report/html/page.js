// SPDX-License-Identifier: AGPL-3.0-or-later
// The table of findings, its filters, the text of the chosen one, and what joins them with the view.
// Every text comes from a file and goes into the page as text, never as markup.

const report = JSON.parse(document.getElementById('report').textContent);
const $ = (id) => document.getElementById(id);
const severities = ['error', 'warning', 'info'];
const severityWords = {error: ['error', 'errors'], warning: ['warning', 'warnings'], info: ['note', 'notes']};
const roleColours = {
  fault: [0.75, 0.36, 0.26], fracture: [0.60, 0.42, 0.66], horizon: [0.87, 0.68, 0.30], unconformity: [0.46, 0.58, 0.36],
  intrusion: [0.74, 0.47, 0.55], boundary: [0.56, 0.65, 0.72], topography: [0.38, 0.58, 0.44], unknown: [0.62, 0.62, 0.60]};
// What a repair did, where that makes parts of their own.
const changeColours = {
  removed: [0.82, 0.10, 0.48], erased: [0.82, 0.10, 0.48], added: [0.10, 0.64, 0.36], cut: [0.42, 0.12, 0.80], joined: [0.00, 0.56, 0.60]};
const groupColours = {...roleColours, lines: [0.15, 0.19, 0.23], ...changeColours};
const groupWords = {unknown: 'no role', lines: 'lines and points', removed: 'left out (before)', erased: 'lines erased (before)',
                    added: 'added (after)', cut: 'lines cut (after)', joined: 'borders joined (after)'};
// From what did not move to what moved farthest: red, green and blue up to 255.
const movedStops = [[0, [208, 212, 216]], [0.12, [253, 224, 128]], [0.4, [249, 152, 64]], [0.7, [214, 48, 62]], [1, [92, 12, 104]]];
function movedColour(share) {
  const s = Math.min(1, Math.max(0, share));
  const next = Math.max(1, movedStops.findIndex(([at]) => at >= s)), [from, low] = movedStops[next - 1], [to, high] = movedStops[next];
  return low.map((v, k) => Math.round(v + (high[k] - v) * (s - from) / (to - from)));
}
const pageOfRows = 500;

// ---- small helpers

// An element with text and children; null children are left out.
function make(tag, attributes, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) {
    if (name === 'class') element.className = value;
    else element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}
const grouped = (n) => String(n).replace(/\B(?=(\d{3})+$)/g, '\u202f');
const counted = (n, [one, many]) => `${grouped(n)} ${n === 1 ? one : many}`;
const figure = (x) => typeof x === 'number' ? String(Number(x.toPrecision(6))) : String(x);
const entityName = (e) => e.name !== '' ? e.name : e.id !== undefined ? `${e.kind} ${e.id}` : e.kind;
const baseName = (path) => path.replace(/^.*\//, '');
// Without its folder, where no other file has the same name.
const shortName = (file) => report.files.some((f) => f !== file && baseName(f.file) === baseName(file.file)) ? file.file : baseName(file.file);
const elementText = (e) => Array.isArray(e) ? `(${e.join(',')})` : String(e);

// ---- rows

// One for each finding of each file.
const rows = [];
report.files.forEach((file, fileIndex) => {
  for (const finding of file.findings) {
    const entity = finding.entities.length ? entityName(finding.entities[0]) : '';
    const words = [finding.code, finding.message, finding.fix, file.file, finding.element_kind,
                   ...finding.entities.flatMap((e) => [e.kind, e.name]), ...(finding.elements || []).map(elementText)];
    rows.push({number: rows.length, fileIndex, finding, entity, count: finding.count || 0,
               words: words.filter((w) => w).join('\n').toLowerCase()});
  }
});

const state = {file: report.files.length > 1 ? -1 : 0, text: '', code: '', entity: '', severities: new Set(severities),
               sort: 'severity', down: false, limit: pageOfRows, chosen: null, shown: []};

const columns = [
  {key: 'severity', title: 'Severity', width: '96px', value: (r) => severities.indexOf(r.finding.severity)},
  {key: 'code', title: 'Code', width: '56px', value: (r) => r.finding.code},
  {key: 'from', title: 'File', width: '18%', value: (r) => report.files[r.fileIndex].file},
  {key: 'entity', title: 'Where', width: '24%', value: (r) => r.entity.toLowerCase()},
  {key: 'message', title: 'What', width: 'auto', value: (r) => r.finding.message.toLowerCase()},
  {key: 'count', title: 'Number', width: '68px', value: (r) => -r.count}];
// The file is told where there are several; then there is less room for the entity.
function columnsShown() {
  const several = state.file < 0 && report.files.length > 1;
  return columns.filter((c) => c.key !== 'from' || several).map((c) => c.key === 'entity' && several ? {...c, width: '18%'} : c);
}

function matches(row, without) {
  const f = row.finding;
  return (state.file < 0 || row.fileIndex === state.file) && (without === 'severity' || state.severities.has(f.severity)) &&
         (without === 'code' || state.code === '' || f.code === state.code) &&
         (without === 'entity' || state.entity === '' || f.entities.some((e) => entityName(e) === state.entity)) &&
         state.text.toLowerCase().split(/\s+/).every((word) => row.words.includes(word));
}

function sorted(list) {
  const value = columns.find((c) => c.key === state.sort).value, way = state.down ? -1 : 1;
  return list.map((row) => [value(row), row])
             .sort(([a, r], [b, s]) => way * (a < b ? -1 : a > b ? 1 : 0) || r.number - s.number).map(([, row]) => row);
}

// ---- the table

function drawHead() {
  $('columns').replaceChildren(...columnsShown().map((column) => {
    const mark = column.key === state.sort ? (state.down ? ' ▾' : ' ▴') : '';
    const button = make('button', {type: 'button'}, column.title + mark);
    button.addEventListener('click', () => {
      state.down = column.key === state.sort && !state.down;
      state.sort = column.key;
      update();
    });
    const head = make('th', {scope: 'col', style: `width:${column.width}`}, button);
    if (mark) head.setAttribute('aria-sort', state.down ? 'descending' : 'ascending');
    return head;
  }));
}

function cellOf(column, row) {
  const f = row.finding;
  switch (column.key) {
    case 'severity': return make('td', {class: 'severity'}, make('span', {class: `dot ${f.severity}`}), severityWords[f.severity][0]);
    case 'code': return make('td', {class: 'code'}, f.code);
    case 'from': return make('td', {class: 'from'}, shortName(report.files[row.fileIndex]));
    case 'entity': {
      const more = f.entities.length - 1;
      return make('td', {class: 'entity', title: row.entity}, make('div', {}, row.entity || '–'),
                  f.entities.length ? make('small', {}, f.entities[0].kind + (more > 0 ? ` + ${grouped(more)}` : '')) : null);
    }
    case 'message': return make('td', {class: 'message'}, make('div', {}, f.message));
    default: return make('td', {class: 'number'}, row.count > 0 ? grouped(row.count) : '');
  }
}

function drawRows() {
  const shown = columnsShown(), some = state.shown.slice(0, state.limit);
  $('rows').replaceChildren(...some.map((row) => {
    const line = make('tr', {'data-row': row.number, 'aria-selected': row === state.chosen}, ...shown.map((c) => cellOf(c, row)));
    line.addEventListener('click', () => choose(row, true));
    return line;
  }));
  const total = rows.filter((row) => state.file < 0 || row.fileIndex === state.file).length;
  $('none').hidden = state.shown.length > 0;
  $('none').textContent = total === 0 ? 'Nothing was found.' : 'No finding passes the filters.';
  $('more').hidden = state.shown.length <= state.limit;
  $('more').textContent = `Show ${grouped(Math.min(pageOfRows, state.shown.length - state.limit))} more`;
  $('shown').textContent = footnote(total);
}

function footnote(total) {
  const files = report.files.filter((_, i) => state.file < 0 || i === state.file);
  const sum = (of) => files.reduce((n, file) => n + (of(file) || 0), 0);
  const parts = [`${grouped(state.shown.length)} of ${counted(total, ['finding', 'findings'])}`];
  const known = sum((file) => file.known && file.known.error + file.known.warning + file.known.info);
  if (known) parts.push(`${grouped(known)} known from the baseline left out`);
  const hidden = sum((file) => file.not_listed);
  if (hidden) parts.push(`${grouped(hidden)} more not listed`);
  return parts.join(' · ');
}

// ---- head and filters

const notJudged = ({only, skip}) => [...(only.length ? ['all but ' + only.join(', ')] : []), ...skip].join('; ');

function drawVerdict() {
  const file = report.files[state.file], verdict = $('verdict');
  if (!file) {
    const bad = report.files.filter((f) => f.valid === false).length;
    verdict.replaceChildren(make('span', {class: `badge ${bad ? 'invalid' : ''}`}, `${grouped(bad)} of ${counted(report.files.length, ['file', 'files'])} not valid`));
    return;
  }
  const part = file.valid === undefined && file.judged;
  const [word, look] = part ? ['no error among the checks run', ''] : file.valid === undefined ? ['not fully checked', ''] : file.valid ? ['valid', 'valid'] : ['not valid', 'invalid'];
  const length = (name, value) => value > 0 ? make('span', {}, `${name} `, make('b', {}, figure(value))) : null;
  const choice = file.judged ? make('span', {}, 'not judged: ', make('b', {}, notJudged(file.judged))) : null;
  const closing = file.closes_with ? make('span', {}, file.closes_with.message) : null;
  verdict.replaceChildren(...[make('span', {class: `badge ${look}`}, word), choice, length('tolerance', file.tolerance),
    length('near', file.near), closing].filter((e) => e));
}

// What a repair did, step by step, with what it decided about borders.
function stepItem(step, unit) {
  const decided = (step.contacts || []).filter((c) => c.decision !== 'left' || (c.on !== '' && c.gap > 0));
  const contacts = decided.map((c) => make('li', {}, `border of '${c.border}'` + (c.on ? ` near '${c.on}'` : '') +
    (c.gap > 0 ? `, gap ${figure(c.gap)}${unit}` : '') + `: ${c.decision}` + (c.why ? `, ${c.why}` : '')));
  const facts = [step.kept ? 'kept' : null, step.changed > 0 ? `${grouped(step.changed)} changed` : null,
                 step.max_displacement > 0 ? `vertices moved by at most ${figure(step.max_displacement)}${unit}, mean ${figure(step.mean_displacement)}${unit}` : null,
                 step.seconds > 0 ? `${figure(Number(step.seconds.toFixed(3)))} s` : null].filter((f) => f);
  return make('li', {}, make('b', {}, step.step), `: ${step.message}. `,
              step.kept ? null : make('span', {class: 'undone'}, `Undone: ${step.why}.`), make('div', {class: 'facts'}, facts.join(' · ')),
              contacts.length ? make('details', {}, make('summary', {}, counted(contacts.length, ['border', 'borders'])), make('ul', {}, ...contacts)) : null);
}

// What became of the names of regions, and what was left out.
function ledger(file) {
  const names = file.steps.flatMap((step) => step.names || []).map((n) => make('li', {}, `region '${n.name}': ` +
    (n.from ? `a part of what was '${n.from}'` : n.change)));
  const removed = (file.removed || []).map((r) => make('li', {}, `${r.step}: ${counted(r.pieces, ['piece', 'pieces'])} of '${r.surface}' ` +
    `(${counted(r.triangles, ['triangle', 'triangles'])}): ${r.why}` + (r.debris ? ` \u2192 ${r.debris.join(', ')}` : '')));
  const list = (title, items) => items.length ? [make('h3', {}, title), make('ul', {}, ...items)] : [];
  return [...list('Names', names), ...list('Left out', removed)];
}

function drawSteps() {
  const file = report.files[state.file] || {}, steps = file.steps || [], box = $('steps');
  const unit = file.changes && file.changes.unit ? ` ${file.changes.unit}` : '';
  box.hidden = steps.length === 0;
  box.querySelector('summary').textContent = counted(steps.length, ['step of repair', 'steps of repair']);
  box.querySelector('ol').replaceChildren(...steps.map((step) => stepItem(step, unit)));
  $('ledger').replaceChildren(...(steps.length ? ledger(file) : []));
}

function drawSeverities() {
  const files = report.files.filter((_, i) => state.file < 0 || i === state.file);
  $('severities').replaceChildren(...severities.map((severity) => {
    const n = files.reduce((sum, file) => sum + file.counts[severity], 0);
    const button = make('button', {type: 'button', 'data-severity': severity, 'aria-pressed': state.severities.has(severity)},
                        make('span', {class: `dot ${severity}`}), counted(n, severityWords[severity]));
    button.addEventListener('click', () => {
      if (!state.severities.delete(severity)) state.severities.add(severity);
      update();
    });
    return button;
  }));
}

function fill(select, first, values, chosen) {
  const options = [make('option', {value: ''}, first), ...values.map(([value, n]) => make('option', {value}, `${value} (${grouped(n)})`))];
  select.replaceChildren(...options);
  select.value = chosen;
}

function tally(list, keysOf) {
  const found = new Map();
  for (const row of list) for (const key of new Set(keysOf(row.finding))) found.set(key, (found.get(key) || 0) + 1);
  return [...found].sort(([a], [b]) => a < b ? -1 : 1);
}

function drawFilters() {
  const codes = tally(rows.filter((row) => matches(row, 'code')), (f) => [f.code]);
  const entities = tally(rows.filter((row) => matches(row, 'entity')), (f) => f.entities.map(entityName));
  if (state.code && !codes.some(([code]) => code === state.code)) codes.push([state.code, 0]);
  if (state.entity && !entities.some(([entity]) => entity === state.entity)) entities.push([state.entity, 0]);
  fill($('code'), 'All codes', codes, state.code);
  fill($('entity'), 'All entities', entities, state.entity);
}

// ---- the chosen finding

// A finding lists no more elements; where it lists fewer, these are all, whatever it counts.
const mostListed = 100;

function listing(items, most, total) {
  const text = items.slice(0, most).join(' ');
  return total > Math.min(most, items.length) ? `${text} and ${grouped(total - Math.min(most, items.length))} more` : text;
}

function drawDetail() {
  const box = $('detail'), row = state.chosen;
  box.hidden = !row;
  if (!row) return;
  const f = row.finding, list = make('dl', {});
  const line = (title, content, look) => {
    if (content) list.append(make('dt', {}, title), make('dd', look ? {class: look} : {}, content));
  };
  line('To mend it', f.fix, 'fix');
  line('Where', f.entities.map((e) => `${e.kind} ${e.name}${e.in_file ? ` (${e.in_file})` : ''}`).join(', '));
  line('At', f.place);
  if (f.elements) line(f.element_kind || 'Elements', listing(f.elements.map(elementText), 24, f.elements.length < mostListed ? f.elements.length : f.count));
  else if (f.count) line('Number', grouped(f.count));
  line('Measures', Object.entries(f.measures || {}).map(([name, value]) => `${name} ${figure(value)}`).join(' · '));
  if (f.location) line('In the file', `${f.location.file}${f.location.line > 0 ? `:${f.location.line}` : ''}${f.location.column ? `:${f.location.column}` : ''}`);
  else if (report.files.length > 1) line('File', report.files[row.fileIndex].file);
  line('Debris', (f.debris || []).join(', '));
  const fly = make('button', {type: 'button'}, 'Fly there');
  fly.addEventListener('click', () => model.flyTo(row));
  box.replaceChildren(make('h2', {}, make('span', {class: `dot ${f.severity}`}), f.code, make('small', {}, report.meanings[f.code] || severityWords[f.severity][0]),
                           model.canFlyTo(row) ? fly : null),
                      make('p', {class: 'message'}, f.message), list);
  box.scrollTop = 0;
}

function choose(row, fly) {
  state.chosen = row;
  const at = state.shown.indexOf(row);
  if (at >= state.limit) {
    state.limit = at + 1;
    drawRows();
  }
  for (const line of $('rows').children) line.setAttribute('aria-selected', Number(line.dataset.row) === (row ? row.number : -1));
  drawDetail();
  model.choose(row, fly);
  const line = row && $('rows').querySelector(`[data-row="${row.number}"]`);
  if (line) line.scrollIntoView({block: 'nearest'});
}

function step(by) {
  if (!state.shown.length) return;
  const at = state.shown.indexOf(state.chosen);
  choose(state.shown[at < 0 ? 0 : Math.min(state.shown.length - 1, Math.max(0, at + by))], true);
}

// ---- all of it

function update() {
  state.shown = sorted(rows.filter((row) => matches(row)));
  if (state.chosen && !state.shown.includes(state.chosen)) state.chosen = null;
  drawHead();
  drawVerdict();
  drawSteps();
  drawSeverities();
  drawFilters();
  drawRows();
  drawDetail();
  model.showMarks(state.shown);
}

function chooseFile(index) {
  state.file = index;
  state.entity = state.code = '';
  state.limit = pageOfRows;
  model.showFile(index >= 0 ? index : Math.max(0, report.files.findIndex((file) => file.scene)));
  update();
}

const model = new ModelView(report, rows, (row) => choose(row, false));

function start() {
  const names = report.files.map((file, i) => make('option', {value: i, title: file.file}, shortName(file)));
  if (report.files.length > 1) names.unshift(make('option', {value: -1}, `All ${grouped(report.files.length)} files`));
  $('file').replaceChildren(...names);
  $('file').value = String(state.file);
  $('file').addEventListener('change', (event) => chooseFile(Number(event.target.value)));
  if (report.files.length === 1) $('from').replaceChildren(make('b', {title: report.files[0].file}, shortName(report.files[0])));
  const listen = (id, key, event) => $(id).addEventListener(event, () => {
    state[key] = $(id).value;
    state.limit = pageOfRows;
    update();
  });
  listen('text', 'text', 'input');
  listen('code', 'code', 'change');
  listen('entity', 'entity', 'change');
  $('more').addEventListener('click', () => {
    state.limit += pageOfRows;
    drawRows();
  });
  $('scroller').addEventListener('keydown', (event) => {
    const by = {ArrowDown: 1, ArrowUp: -1, PageDown: 10, PageUp: -10}[event.key];
    if (by === undefined) return;
    event.preventDefault();
    step(by);
  });
  if (model.changes) {  // what was done comes first, and notes would lie on it
    $('steps').open = true;
    state.severities.delete('info');
  }
  chooseFile(state.file);
  model.fit();
  // For tests: what is shown and chosen, and where a mark stands on the screen.
  window.geomendReport = {state, rows, choose: (n) => choose(rows[n], true), view: () => model.kind(), at: (n) => model.placeOf(rows[n]),
                          settled: () => model.settled(), poses: () => model.views.map((view) => view.pose())};
  document.documentElement.dataset.ready = model.kind();
}

start();
