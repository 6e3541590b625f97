using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>Which bodies are asked whether they meet: all of them while they are few, those that come near once they are many.</content>
public sealed partial class Simulation
{
    /// <summary>The size of a cell in radii of a body that nine tenths are not larger than: two diameters.</summary>
    private const double CellInRadii = 4;

    /// <summary>At about so many others a body looks, however many there are.</summary>
    internal const int MostLooks = 64;

    private int mostPairs;
    private IPairIndex index = new AllPairs();
    private int outgrownAt; // number of bodies too wide or fast for the cells at which other cells are tried

    /// <summary>
    /// Uses the index from now on above so many bodies, 0 for always; a world that has it keeps it. No bit depends on it. It is for
    /// tests: worlds small enough to be played by the thousand would never use it.
    /// </summary>
    internal void UseIndexAbove(int bodies)
    {
        mostPairs = bodies;
        FitIndex();
    }

    /// <summary>Looks whether the bodies have become so many, or so much larger, that another index serves them better.</summary>
    private void FitIndex()
    {
        bool outgrown = index is ShellIndex shells && shells.WideCount > Math.Max(outgrownAt, bodies.Count / 8);
        if (!outgrown && (index is ShellIndex || bodies.Count <= mostPairs))
        {
            return;
        }

        if (!rollback.IsActive && rollback.Cursor.Time <= SimulatedTo)
        {
            // The clock shows the last event, which may be long ago, and the index would list nobody between then and now.
            rollback.Cursor = EventKey.Before(SimulatedTo + SimDuration.OneTick);
        }

        index = NewIndex();
        for (int n = 0; n < bodies.Count; n++)
        {
            int slot = bodies.SlotAt(n);
            for (int at = timelines.First(slot); at != TimelineStore.None; at = timelines.Next(at))
            {
                int next = timelines.Next(at);
                SimTime from = SimTime.Max(HistoryEdge, timelines.Key(at).Time);
                SimTime until = next == TimelineStore.None ? SimTime.Max(from, rollback.Cursor.Time) : timelines.Key(next).Time;
                if (timelines.Segment(at).IsPresent && until >= from)
                {
                    index.Add(slot, bodies.Spec(slot).Radius, at, from, until);
                }
            }
        }

        for (int n = 0; n < bodies.Count; n++)
        {
            Predict(bodies.SlotAt(n));
        }

        outgrownAt = 2 * Math.Max(32, ((ShellIndex)index).WideCount);
    }

    private ShellIndex NewIndex()
    {
        double[] radii = new double[bodies.Count];
        double[] speeds = new double[bodies.Count];
        int count = 0;
        int present = 0;
        foreach (int slot in bodies)
        {
            double radius = bodies.Spec(slot).Radius;
            radii[count] = radius;
            count += radius > 0 ? 1 : 0; // none yet: a body of which nothing but its name was heard
            ref readonly MotionSegment path = ref timelines.Segment(timelines.Last(slot));
            speeds[present] = path.Velocity.Length;
            present += path.IsPresent ? 1 : 0;
        }

        Array.Sort(radii, 0, count);
        Array.Sort(speeds, 0, present);
        double usual = count == 0 ? Scene.SmallestRadius : radii[count * 9 / 10];
        double usualSpeed = present == 0 ? 0 : speeds[present * 9 / 10];
        double tick = Limits.MaxSpeed(Scene.SmallestRadius) * TickConversion.SecondsPerTick;
        return new ShellIndex(timelines, CellInRadii * usual, usualSpeed, Scene.Resolution, tick, Scene.Box, bodies.SlotCount)
        {
            ForgetsWhoMovedOn = faults.Has(HealingFault.ForgetsWhoMovedOn),
        };
    }
}
