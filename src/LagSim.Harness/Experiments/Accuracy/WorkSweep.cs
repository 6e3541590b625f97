using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Harness.Experiments.Metrics;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>
/// Measures speed against error: each method on each scene, with its step or tolerance swept. Error and time are measured in separate runs.
/// </summary>
public static class WorkSweep
{
    private const double MaxSeconds = 1e6; // the most a timer can count
    private const double Long = 1; // seconds: a longer run is timed once, after the run that measured its error

    /// <summary>Runs scenes with methods.</summary>
    /// <param name="scenes">The scenes.</param>
    /// <param name="methods">The methods. One that is missing or does not suit a scene is left out, with a sentence.</param>
    /// <param name="options">How thorough the sweep is.</param>
    /// <param name="progress">Called with the fraction of all points that is done, 0 to 1.</param>
    /// <param name="cancellation">Ends it between two steps or instants of a run, with the points of the methods that were done by
    /// then.</param>
    /// <param name="begin">Called with the names of a scene and a method before they run.</param>
    public static WorkReport Run(
        IReadOnlyList<WorkScene> scenes, IReadOnlyList<IWorkMethod> methods, WorkOptions options, Action<double>? progress = null,
            CancellationToken cancellation = default, Action<string>? begin = null)
    {
        ArgumentNullException.ThrowIfNull(scenes);
        ArgumentNullException.ThrowIfNull(methods);
        ArgumentNullException.ThrowIfNull(options);
        List<WorkPoint> points = [];
        List<WorkOrder> orders = [];
        List<string> leftOut = [.. methods.Where(method => method.Missing is not null).DistinctBy(method => method.Engine)
            .Select(method => $"{method.Name} is left out: {method.Missing}.")];
        (WorkScene Scene, IWorkMethod Method)[] sweeps =
            [.. scenes.SelectMany(scene => methods.Where(method => method.Missing is null).Select(method => (scene, method)))];
        for (int n = 0; n < sweeps.Length; n++)
        {
            (WorkScene scene, IWorkMethod method) = sweeps[n];
            if (method.Excludes(scene) is string why)
            {
                string where = RandomHeapWork.IsDrawn(scene.Name) ? RandomHeapWork.Set : scene.Name;
                string sentence = $"{where}: {method.Name} is left out: {why}.";
                if (!leftOut.Contains(sentence))
                {
                    leftOut.Add(sentence);
                }

                continue;
            }

            int done = n;
            string at = $"{scene.Name}: {method.Name}";
            List<WorkPoint> swept;
            try
            {
                begin?.Invoke(at);
                swept = Sweep(scene, method, options, leftOut, part => progress?.Invoke((done + part) / sweeps.Length), cancellation);
            }
            catch (OperationCanceledException) when (cancellation.IsCancellationRequested)
            {
                return new WorkReport(points, orders, leftOut) { StoppedAt = at };
            }

            points.AddRange(swept);
            if (WorkOrder.Of(scene, swept.Where(point => point.ErrorKind == scene.ErrorKinds[0])) is WorkOrder order)
            {
                orders.Add(order);
            }
        }

        return new WorkReport(points, orders, leftOut);
    }

    private static List<WorkPoint> Sweep(
        WorkScene scene, IWorkMethod method, WorkOptions options, List<string> leftOut, Action<double> progress, CancellationToken cancellation)
    {
        List<WorkPoint> points = [];
        WorkSetting[] settings = [.. method.Settings(scene).Take(options.MaxSettings)];
        for (int n = 0; n < settings.Length; n++)
        {
            cancellation.ThrowIfCancellationRequested();
            progress((double)n / settings.Length);
            WorkSetting setting = settings[n];
            string at = $"{scene.Name}: {method.Name} at {setting.Text}{(n + 1 < settings.Length ? " and finer" : "")} is left out:";
            double expected = points.Count == 0 ? 0 : points[^1].CpuSeconds * Finer(points[^1].StepSeconds / setting.StepSeconds);
            if (expected > options.LongestSeconds)
            {
                leftOut.Add(FormattableString.Invariant(
                    $"{at} it would take about {expected:0.#} s a run, and {options.LongestSeconds} s are allowed."));
                break;
            }

            using CancellationTokenSource limit = CancellationTokenSource.CreateLinkedTokenSource(cancellation);
            try
            {
                points.AddRange(Point(scene, method, setting, options, isFirst: n == 0, limit));
            }
            catch (OperationCanceledException) when (!cancellation.IsCancellationRequested)
            {
                leftOut.Add(FormattableString.Invariant(
                    $"{at} a run was not done after {options.BreakOffSeconds} s, and {options.LongestSeconds} s a run are allowed."));
                break;
            }
        }

        return points;

        // Without steps, a finer setting takes at least as long as a coarser one.
        static double Finer(double steps) => double.IsNaN(steps) ? 1 : steps;
    }

    /// <summary>Measures the errors of a setting and its time, in separate runs. Returns a point for each kind of error.</summary>
    private static IEnumerable<WorkPoint> Point(
        WorkScene scene, IWorkMethod method, WorkSetting setting, WorkOptions options, bool isFirst, CancellationTokenSource limit)
    {
        TimeSpan longest = TimeSpan.FromSeconds(Math.Min(MaxSeconds, options.BreakOffSeconds));
        limit.CancelAfter(longest);
        IReadOnlyList<double> errors;
        long events;
        using (IWorkRun run = method.Start(scene, setting, limit.Token))
        {
            errors = scene.Measure(run);
            events = run.Events;
        }

        limit.CancelAfter(longest);
        (double cpu, int runs) = Time(scene, method, setting, options, limit.Token);
        for (double before = double.MaxValue; isFirst && cpu < Math.Min(0.9 * before, Long);)
        {
            before = cpu; // the JIT compiler may still be at work: repeat until it is no faster
            limit.CancelAfter(longest);
            (cpu, runs) = Time(scene, method, setting, options, limit.Token);
        }

        return errors.Select((error, kind) => new WorkPoint(
            scene.Name, method.Name, setting.Text, setting.StepSeconds, error, scene.ErrorKinds[kind], cpu, runs, scene.Seconds, events));
    }

    /// <summary>
    /// Returns the least time of several runs. It includes making the world, but neither making the scene nor freeing memory, and nothing
    /// is read.
    /// </summary>
    private static (double Seconds, int Runs) Time(WorkScene scene, IWorkMethod method, WorkSetting setting, WorkOptions options,
        CancellationToken cancellation)
    {
        double least = double.MaxValue, all = 0;
        int runs = 0;
        while (all < options.TimingSeconds || (runs < options.FewestRuns && least < Long))
        {
            cancellation.ThrowIfCancellationRequested();
            double began = ThreadClock.Microseconds;
            using IWorkRun run = method.Start(scene, setting, cancellation);
            run.AdvanceTo(scene.Seconds);
            double spent = (ThreadClock.Microseconds - began) * 1e-6;
            least = Math.Min(least, spent);
            all += Math.Max(spent, 1e-7);
            runs++;
        }

        return (least, runs);
    }
}
