using System;
using System.Collections.Generic;
using System.IO;
using System.Text;
using System.Text.Json;
using LagSim.Harness.Experiments.Drop;
using LagSim.Harness.Experiments.Hands;
using LagSim.Harness.Experiments.Hold;
using LagSim.Harness.Experiments.Peers;

namespace LagSim.Play;

/// <summary>
/// The thesis's tests as the page runs them: what <c>lagsim drop --time virtual --strategy all</c> and <c>lagsim hold --time virtual</c>
/// run, with the same options, and figures of the same names.
/// </summary>
/// <remarks>On the thread of the caller, which they keep busy for seconds. The same seed gives the same figures on every runtime.</remarks>
internal static class ThesisTests
{
    private const int ChartColumns = 360;
    private const double LeastProgress = 0.01;
    private const double SessionsPart = 0.45; // of the time that the test of a hand takes; the rest is its prediction

    /// <summary>Runs the drop test: both halves as one run, then the lift with each strategy.</summary>
    /// <param name="seed">The seed of links and clocks.</param>
    /// <param name="report">Gets each run once it is done, as JSON: <c>run</c>, as the tool has it, and <c>points</c> for a chart: seconds,
    /// the height of the ball as either peer showed it, and their distance, in metres; null where it was not shown.</param>
    /// <param name="progress">Gets the fraction that is done, up to once for each hundredth.</param>
    /// <exception cref="PeerGroupException">The peers did not connect, or one dropped out.</exception>
    internal static void RunDrop(ulong seed, Action<string> report, Action<double> progress)
    {
        DropOptions both = new() { IsVirtual = true, Seed = seed };
        IReadOnlyList<DropOptions> each = [both, .. both.ForEveryStrategy()];
        double total = 0, before = 0;
        foreach (DropOptions options in each)
        {
            total += options.Length.ToSeconds();
        }

        Action<double> tell = Sparsely(progress);
        foreach (DropOptions options in each)
        {
            foreach (DropRun run in DropTest.Run(options, done => tell((before + done.ToSeconds()) / total)))
            {
                report(Json(json =>
                {
                    json.WritePropertyName("run");
                    DropRunJson.Write(json, run);
                    WritePoints(json, run.Trace);
                }));
            }

            before += options.Length.ToSeconds();
        }
    }

    /// <summary>Runs the test of a hand: one session for each delay, then the prediction of the same motion from all of its samples.</summary>
    /// <param name="seed">The seed of links, clocks and the motion of the hand.</param>
    /// <param name="report">Gets each run once it is done, and each delay of the prediction, as JSON: <c>run</c> or <c>prediction</c>, as the
    /// tool has them.</param>
    /// <param name="progress">Gets the fraction that is done, up to once for each hundredth.</param>
    /// <exception cref="PeerGroupException">The peers did not connect, or one dropped out.</exception>
    internal static void RunHold(ulong seed, Action<string> report, Action<double> progress)
    {
        HandMotion motion = HandMotions.Generate(HandMotions.Random, seed);
        HoldOptions all = new(motion) { IsVirtual = true, Seed = seed };
        Action<double> tell = Sparsely(progress);
        double length = all.Length.ToSeconds();
        for (int n = 0; n < HoldOptions.Delays.Count; n++)
        {
            int before = n;
            HoldRun run = HoldTest.Run(
                all.At(HoldOptions.Delays[n]), done => tell(SessionsPart * (before + (done.ToSeconds() / length)) / HoldOptions.Delays.Count));
            report(Json(json =>
            {
                json.WritePropertyName("run");
                HoldRunJson.Write(json, run);
            }));
        }

        IReadOnlyList<double> horizons = PredictionTest.DefaultHorizonsMilliseconds;
        for (int n = 0; n < horizons.Count; n++)
        {
            PredictionError error = PredictionTest.Run(motion, horizons[n]);
            tell(SessionsPart + ((1 - SessionsPart) * (n + 1) / horizons.Count));
            report(Json(json =>
            {
                json.WritePropertyName("prediction");
                PredictionErrorJson.Write(json, error);
            }));
        }
    }

    /// <summary>Writes a sample for each column of a chart: the one in which the peers are furthest apart, so that none is lost.</summary>
    private static void WritePoints(Utf8JsonWriter json, DropTrace trace)
    {
        json.WriteStartArray("points");
        int columns = Math.Min(ChartColumns, trace.Seconds.Length);
        for (int column = 0; column < columns; column++)
        {
            int first = (int)((long)column * trace.Seconds.Length / columns), end = (int)((column + 1L) * trace.Seconds.Length / columns);
            int worst = first;
            for (int n = first; n < end; n++)
            {
                worst = trace.SeenError[n] > trace.SeenError[worst] ? n : worst;
            }

            json.WriteStartArray();
            Write(trace.Seconds[worst]);
            Write(trace.Heights[0][worst]);
            Write(trace.Heights[1][worst]);
            Write(trace.SeenError[worst]);
            json.WriteEndArray();
        }

        json.WriteEndArray();

        void Write(double value)
        {
            if (double.IsFinite(value))
            {
                json.WriteNumberValue(value);
            }
            else
            {
                json.WriteNullValue();
            }
        }
    }

    private static Action<double> Sparsely(Action<double> progress)
    {
        double told = 0;
        return done =>
        {
            if (done - told >= LeastProgress)
            {
                told = done;
                progress(done);
            }
        };
    }

    private static string Json(Action<Utf8JsonWriter> write)
    {
        using MemoryStream stream = new();
        using (Utf8JsonWriter json = new(stream))
        {
            json.WriteStartObject();
            write(json);
            json.WriteEndObject();
        }

        return Encoding.UTF8.GetString(stream.ToArray());
    }
}
