// Runs a test of the thesis in a runtime of its own, beside the page, which goes on meanwhile. Its address says which:
// thesis-worker.mjs?test=drop&seed=1. It tells {progress}, {run, points?} for each run, and at the end {done} or {failure}.
import { dotnet } from './_framework/dotnet.js'

const asked = new URLSearchParams(location.search)
try {
  const { getAssemblyExports, getConfig, setModuleImports } = await dotnet.create()
  setModuleImports('worker', {
    report: text => postMessage(JSON.parse(text)),
    progress: progress => postMessage({ progress }),
  })
  const { ThesisExports } = (await getAssemblyExports(getConfig().mainAssemblyName)).LagSim.Play.Browser
  const tests = { drop: ThesisExports.RunDrop, hold: ThesisExports.RunHold }
  tests[asked.get('test')](Number(asked.get('seed')))
  postMessage({ done: true })
} catch (failure) {
  postMessage({ failure: String(failure.message ?? failure) })
}
