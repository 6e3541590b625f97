// Runs the program of this folder in Node.js, and gives it what WebAssembly has not: files, and a UDP socket.
import dgram from 'node:dgram'
import fs from 'node:fs'
import path from 'node:path'
import { dotnet } from './_framework/dotnet.js'

const socket = dgram.createSocket('udp4')
const arrived = []
socket.on('message', (bytes, from) => arrived.push(Uint8Array.of(from.port >> 8, from.port & 255, ...bytes)))
await new Promise(bound => socket.bind(0, '127.0.0.1', bound))

const given = process.argv.slice(2)
const folder = given.length === 1 && fs.existsSync(given[0]) ? path.resolve(given[0]) : null
const { setModuleImports, runMain, Module } = await dotnet.withApplicationArguments(...(folder ? [folder] : given)).create()
if (folder) {
  Module.FS_createPath('/', folder, true, true)
  for (const name of fs.readdirSync(folder)) {
    Module.FS_createDataFile(folder, name, fs.readFileSync(path.join(folder, name)), true, true, true)
  }
}

setModuleImports('udp', {
  port: () => socket.address().port,
  send: (bytes, to) => socket.send(bytes, to, '127.0.0.1'),
  receive: () => arrived.shift() ?? new Uint8Array(0), // the sender's port in two bytes, then the datagram
})
process.exit(await runMain())
