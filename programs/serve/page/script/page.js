// SPDX-License-Identifier: Apache-2.0
// The page: which launch is shown, and what is done when it or the service goes away and comes again.

const LIST_PERIOD = 3000;  // milliseconds
const TOLD_FOR = 6000;

const page = {
  launches: [],
  pid: 0,          // of the launch that is followed; 0: none
  last: null,      // what was known of the launch that was followed last
  process: '',     // whose lines are shown
  stop: () => {},  // ends the following
  steers: false,
};

const table = new ProcessTable(byId('processes'), chooseProcess, steer);
const log = new LineLog(byId('log'), byId('follow'));
const nodes = new NodeTables(byId('nodes-panel'), byId('nodes-shown'), byId('nodes'));
const events = new EventList(byId('events'), byId('events-empty'));

function setLink(text, kind) {
  setText(byId('link'), text);
  byId('link').className = `badge ${kind}`;
}

function notice(text) {
  setText(byId('notice'), text);
  byId('notice').hidden = !text;
}

let toldTimer = 0;
function tell(text, bad = false) {
  setText(byId('told'), text);
  byId('told').classList.toggle('bad', bad);
  clearTimeout(toldTimer);
  toldTimer = setTimeout(() => setText(byId('told'), ''), TOLD_FOR);
}

// Resolves to whether the user agrees.
function question(text, yes) {
  const dialog = byId('question');
  setText(byId('question-text'), text);
  setText(byId('question-yes'), yes);
  dialog.returnValue = 'no';
  dialog.showModal();
  return new Promise(done => dialog.addEventListener('close', () => done(dialog.returnValue === 'yes'), {once: true}));
}

async function steer(verb, name) {
  const label = verb[0].toUpperCase() + verb.slice(1);
  if (verb !== 'start' && !await question(`${label} ${name}?`, label)) {
    return;
  }
  try {
    const answer = await ask(`/api/launches/${page.pid}`, {do: verb, processes: [name]});
    const refused = answer.refused?.[0];
    tell(refused ?? `${verb} ${name}: asked for`, Boolean(refused));
  } catch (error) {
    tell(error.message, true);
  }
}

async function shutDown() {
  if (!await question(`End the whole launch ${filesText(page.last)}?`, 'Shut down')) {
    return;
  }
  try {
    await ask(`/api/launches/${page.pid}`, {do: 'shutdown'});
    tell('the launch was asked to end');
  } catch (error) {
    tell(error.message, true);
  }
}

function chooseProcess(name) {
  page.process = name;
  table.chosen = name;
  table.show();
  setText(byId('log-title'), `Output of ${name}`);
  if (page.pid) {
    followLaunch(page.pid);
  }
  if (matchMedia('(max-width: 760px)').matches) {
    byId('log-title').scrollIntoView();  // the lines are far below the rows of a phone
  }
}

function showAbout(launch) {
  const files = filesText(launch);
  const total = table.total();
  setText(byId('files'), files);
  document.title = `${files} - launches`;
  const count = table.rows.size;
  setText(byId('facts'), [
    `launch ${launch.pid}`, `${launch.state} for ${durationText(launch.running_for ?? Date.now() / 1000 - launch.started)}`,
    `${count} process${count === 1 ? '' : 'es'}`, `${total.cpu.toFixed(0)} % CPU`, memoryText(total.memory), launch.directory,
  ].filter(Boolean).join(', '));
  byId('shutdown').disabled = launch.state === 'ending';
}

function followLaunch(pid) {
  page.stop();
  if (pid !== page.pid) {
    table.clear();
    events.clear();
  }
  page.pid = pid;
  byId('launch').value = String(pid);
  log.clear();
  byId('log').hidden = !page.process;
  byId('log-empty').hidden = Boolean(page.process);
  page.stop = follow(pid, page.process, {
    ps(answer) {
      page.last = answer.launch;
      table.steers = page.steers;
      table.update(answer);
      showAbout(answer.launch);
      byId('about').hidden = byId('columns').hidden = false;
      byId('shutdown').hidden = !page.steers;
      setLink('live', 'good');
      notice('');
      ready();
    },
    event: event => events.add(event),
    output(event) {
      log.add(event.line, event.stream);
    },
    end(why) {
      lose(why.error);
    },
    lost: () => lose(),
  });
}

// The launch has ended, or the service has: the list tells.
function lose(why) {
  page.stop();
  page.pid = 0;
  setLink('waiting', '');
  if (why) {
    notice(why);
  }
  lookForLaunches();
}

// The same launch again: the same files, started in the same directory.
function isSame(launch, other) {
  return other && launch.directory === other.directory && JSON.stringify(launch.files) === JSON.stringify(other.files);
}

function showList() {
  const list = byId('launch');
  const options = page.launches.map(launch => element('option', {value: String(launch.pid)}, `${launch.pid}: ${filesText(launch)}`));
  if (!page.pid) {
    options.unshift(element('option', {value: ''}, 'choose'));
  }
  if (list.textContent !== options.map(option => option.textContent).join('')) {
    list.replaceChildren(...options);
  }
  list.value = page.pid ? String(page.pid) : '';
  document.querySelector('.choice').hidden = page.launches.length < (page.pid ? 2 : 1);
}

let listTimer = 0;
async function lookForLaunches() {
  clearTimeout(listTimer);
  listTimer = setTimeout(lookForLaunches, page.pid ? LIST_PERIOD : LIST_PERIOD / 3);
  try {
    const answer = await ask('/api/launches');
    page.launches = answer.launches;
    page.steers = answer.control;
    nodes.allow(answer.nodes);
    byId('rights').hidden = page.steers;
  } catch (error) {
    setLink('no connection', 'bad');
    notice(`${error.message}; this page tries again`);
    return;
  }
  if (!page.pid) {
    chooseLaunch();
  }
  showList();
}

function chooseLaunch() {
  const found = page.launches.find(launch => isSame(launch, page.last)) ??
    (!page.last && page.launches.length === 1 ? page.launches[0] : null);
  if (found) {
    followLaunch(found.pid);
  } else if (page.last) {
    setLink('ended', '');
    notice(`The launch of ${filesText(page.last)} has ended. This page goes on when it is started again.`);
    byId('shutdown').hidden = true;
    table.steers = false;
    table.show();
  } else {
    setLink('waiting', '');
    notice(page.launches.length ? 'Several launches run. Choose one.' : 'No launch runs. This page goes on when one is started.');
    ready();
  }
}

// For tests, and for who looks at the page by a program.
function ready() {
  document.body.dataset.ready = 'yes';
}

byId('launch').addEventListener('change', event => {
  if (event.target.value) {
    page.process = '';
    table.chosen = '';
    setText(byId('log-title'), 'Output');
    followLaunch(Number(event.target.value));
    showList();
  }
});
byId('shutdown').addEventListener('click', shutDown);
byId('search').addEventListener('input', event => {
  table.search = event.target.value;
  table.show();
});
byId('log-search').addEventListener('input', event => log.find(event.target.value));
byId('follow').addEventListener('change', event => event.target.checked && log.scrollDown());
lookForLaunches();
