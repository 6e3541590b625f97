using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>
/// What becomes of the inputs of a host and three clients, two of whom hold a stick and two a body, 30 times a second, on each link; and what
/// it costs that the watermark waits for them: in virtual time, with the history of a second alone, and with the default of thrice that at the
/// most.
/// </summary>
internal static class LateInputTable
{
    private const int Clients = 3;
    private const double Rate = 30, Seconds = 30;

    internal static void Print(bool isBrief)
    {
        long all = 0, refused = 0, moved = 0;
        Console.WriteLine("| link | longest history, s | inputs | refused | moved | without a verdict | all agree | watermark behind: p50, s | p99 | max | segments after it, at the most | heals |");
        Console.WriteLine("|---|---|---|---|---|---|---|---|---|---|---|---|");
        foreach (string link in isBrief ? ["wifi-good", "blackout", "delay-2000ms"] : LinkProfiles.Names)
        {
            foreach (double longest in new double[] { 1, 3 })
            {
                Row row = new();
                for (ulong seed = 1; seed <= (isBrief ? 1UL : 11); seed++)
                {
                    row.Play(link, longest, seed);
                }

                Console.WriteLine(row.Text(link, longest));
                (all, refused, moved) = longest > 1 ? (all + row.Inputs, refused + row.Refused, moved + row.Moved) : (all, refused, moved);
            }
        }

        Console.WriteLine(string.Create(CultureInfo.InvariantCulture, $"With 3 s: {all:N0} inputs, {refused:N0} refused, {moved:N0} moved."));
    }

    private sealed class Row
    {
        private readonly List<double> behind = [];
        private int segments;
        private long heals, judged;
        private bool agree = true;

        internal long Inputs { get; private set; }

        internal long Refused { get; private set; }

        internal long Moved { get; private set; }

        internal void Play(string link, double longest, ulong seed)
        {
            SceneBuilder builder = new SceneBuilder("marbles").AddPlane("floor", Vector3D.Up, Vector3D.Zero);
            for (int n = 0; n <= Clients; n++)
            {
                builder.AddBody(Name(n), new BodySpec(0.3, 1, 0.6, friction: 0.5, rollingResistance: 0.02), new Vector3D(n * 2.5, 0.3, 0));
            }

            Scene scene = builder.Build();
            SessionTest test = new SessionTest(scene).WithClients(Clients, link).WithSeed(seed)
                .WithOptions(player => player == 0 ? new HostOptions { LongestHistory = SimDuration.FromSeconds(longest) } : new ClientOptions());
            for (int player = 0; player <= Clients; player++)
            {
                BodyId body = scene.BodyNamed(Name(player));
                bool isStick = player < 2; // what a hand does cannot happen later than it is done: it would be refused
                double x = player * 2.5;
                int n = 0;
                test = test.Every(1 / Rate, player, me =>
                {
                    if (me.Session is HostSession host)
                    {
                        behind.Add((host.SharedTime.Now - host.Watermark).ToSeconds());
                        segments = n % 10 == 0 ? Math.Max(segments, SegmentsAfter(host.Watermark, host.World!.Simulation)) : segments;
                    }

                    me.Do(isStick ? PlayerAction.Impulse(body, new Vector3D(n % 20 < 10 ? 0.1 : -0.1, 0, 0))
                        : n == 0 ? PlayerAction.Grab(body)
                        : PlayerAction.HoldKeyframe(body, new Vector3D(x + (0.2 * Math.Sin(0.1 * n)), 0.6, 0), new Vector3D(0.6 * Math.Cos(0.1 * n), 0, 0)));
                    n++;
                    Inputs++;
                });
            }

            SessionTestResult result = test.RunUnchecked(Seconds);
            judged += result.EventsAccepted + result.EventsRefused;
            Refused += result.EventsRefused;
            Moved += result.EventsMoved;
            heals += result.Heals;
            agree &= result.WorldsAgree;
        }

        internal string Text(string link, double longest)
        {
            double[] sorted = [.. behind.Order()];
            return string.Create(
                CultureInfo.InvariantCulture,
                $"| {link} | {longest} | {Inputs} | {Refused} | {Moved} | {Inputs - judged} | {(agree ? "yes" : "no")} | {At(0.5):F2} | {At(0.99):F2} | {At(1):F2} | {segments} | {heals} |");

            double At(double share) => sorted[(int)(share * (sorted.Length - 1))];
        }

        /// <summary>How many pieces of paths may still change: what a world keeps for the history.</summary>
        private static int SegmentsAfter(SimTime watermark, Simulation world)
        {
            int count = 0;
            for (int slot = 0; slot <= Clients; slot++)
            {
                int segment = world.Engine.Timelines.Last(slot);
                for (; segment >= 0 && world.Engine.Timelines.Key(segment).Time >= watermark; segment = world.Engine.Timelines.Previous(segment))
                {
                    count++;
                }
            }

            return count;
        }

        private static string Name(int player) => FormattableString.Invariant($"marble {player}");
    }
}
