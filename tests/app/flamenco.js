// A stand-in for Flamenco's manager: compiles the job type that the first argument names, and prints a script that does
// its tasks as one worker would. A call that Flamenco 3 does not have, or refuses, ends it with 1.
const fs = require("fs"), vm = require("vm");

const expect = (holds, what) => { if (!holds) { console.error(what); process.exit(1); } };
const isText = value => typeof value === "string" && value.trim() !== "";
const workersDo = ["blender", "ffmpeg", "file-management", "misc"];  // as they come
const settingTypes = ["string", "int32", "float", "bool"];

class Task {
    constructor(name, type) {
        expect(isText(name) && workersDo.includes(type), `author.Task(${name}, ${type})`);
        Object.assign(this, { name, commands: [], dependencies: [] });
    }
    addCommand(command) { this.commands.push(command); }
    addDependency(task) { expect(task instanceof Task, "addDependency"); this.dependencies.push(task); }
}
const author = {
    Task: function (name, type) { return new Task(name, type); },
    Command: (name, { exe, args, ...rest }) => {
        expect(name === "exec" && isText(exe) && args.every(isText) && Object.keys(rest).length === 0, `Command ${name}`);
        return [exe, ...args];
    },
};

const tasks = [];
const { JOB_TYPE, compileJob } =
    vm.runInNewContext(fs.readFileSync(process.argv[2]) + "; ({ JOB_TYPE, compileJob })", { author });
expect(isText(JOB_TYPE.label), "label");
const settings = {};
for (const { key, type, required, default: value, description, ...rest } of JOB_TYPE.settings) {
    expect(/^[a-z_]+$/.test(key) && settingTypes.includes(type) && Object.keys(rest).length === 0, `setting ${key}`);
    settings[key] = value;
}
// The manager takes a task as it is when it is added.
compileJob({ name: "a job", settings, addTask: task => tasks.push(Object.assign(new Task(task.name, "misc"), task)) });

const quoted = word => `'${word.replaceAll("'", "'\\''")}'`;
const added = new Set();
console.log("set -e");
for (const task of tasks) {
    for (const { name } of task.dependencies) expect(added.has(name), `${task.name} waits for ${name}`);
    expect(!added.has(task.name) && task.commands.length > 0, `task ${task.name}`);
    added.add(task.name);
    for (const command of task.commands) console.log(command.map(quoted).join(" "));
}
