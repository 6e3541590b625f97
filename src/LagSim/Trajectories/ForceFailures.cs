using System.Text;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Trajectories;

/// <summary>The error messages for a program's own forces that cannot be followed, and for forces that fill the timelines.</summary>
internal sealed class ForceFailures(Scene scene, BodyTable bodies, TimelineStore timelines)
{
    /// <summary>Why a flight under a program's own forces cannot be followed from a state on.</summary>
    /// <param name="slot">The body.</param>
    /// <param name="from">When the step begins.</param>
    /// <param name="x">The position then.</param>
    /// <param name="v">The velocity then.</param>
    /// <param name="isFinite">Whether the accelerations in the step are.</param>
    internal SimulationException OfSupplied(int slot, SimTime from, in Vector3D x, in Vector3D v, bool isFinite)
    {
        ref readonly BodySpec spec = ref bodies.Spec(slot);
        string names = spec.Forces.NamesAmong(scene.ForceArray);
        string state = $"at {Limits.Short(x)} m and {Limits.Short(v)} m/s";
        return new SimulationException(isFinite
            ? $"From {from.ToShortString()} on, {state}, the forces {names} on {scene.Describe(bodies.Id(slot))} change faster than the shortest step follows."
                + $" Make them weaker, or allow a larger error.{Jumps(spec)}"
            : $"In the step from {from.ToShortString()}, {state}, the acceleration of {scene.Describe(bodies.Id(slot))} became NaN or infinite; what"
                + $" the forces {names} give must be finite.");
    }

    /// <summary>Why a body can be followed no further, as a sentence.</summary>
    internal string OfLoss(int slot, SimTime time, LossReason reason, in Vector3D x, in Vector3D v, in Vector3D spin)
    {
        string names = bodies.Spec(slot).Forces.NamesAmong(scene.ForceArray);
        string rates = RatesOn(slot, x, v, spin);
        string there = rates.Length > 0 ? $": there {rates}" : "";
        string why = reason switch
        {
            LossReason.TooFast => $"it would be faster than {Limits.Text(Limits.MaxSpeed(scene.SmallestRadius))} m/s, a fifth of the smallest radius in a tick{there}",
            LossReason.TooStiff => $"the forces on it change faster than the shortest step follows{there}",
            LossReason.NoRoom => "a hand let it go there, and the static geometry that stops it leaves it no room",
            _ => $"what the forces {names} give there has no finite value",
        };
        return $"At {time.ToShortString()} {scene.Describe(bodies.Id(slot))} cannot be followed any further, at {Limits.Short(x)} m with {Limits.Short(v)} m/s: {why}.";
    }

    /// <summary>
    /// A message about what error control cannot follow and only the program's author can see; it follows another sentence.
    /// </summary>
    private string Jumps(in BodySpec spec)
    {
        foreach (Force force in spec.Forces.Among(scene.ForceArray))
        {
            if (force.Kind == ForceKind.Supplied && spec.Flight == MotionLaw.DormandPrince54 && spec.Tolerance > 0)
            {
                return $" If '{force.Name}' jumps, between two places or at a change of sign, error control takes the shortest steps there are at the jump: "
                    + "take fixed steps, with a tolerance of 0, or make it continuous.";
            }
        }

        return "";
    }

    /// <summary>The forces that act on a body at a state, and their rates.</summary>
    private string RatesOn(int slot, in Vector3D x, in Vector3D v, in Vector3D spin)
    {
        ref readonly BodySpec spec = ref bodies.Spec(slot);
        StringBuilder text = new();
        foreach (Force force in spec.Forces.Among(scene.ForceArray))
        {
            string rate = force.Kind == ForceKind.Supplied ? "at a rate that is the program's" : $"at {Limits.Short(force.RateAt(spec.Mass, x, v, spin))} 1/s";
            text.Append(text.Length > 0 ? ", " : "").Append($"'{force.Name}' ({force.Kind}) acts {rate}");
        }

        return text.ToString();
    }

    /// <summary>
    /// The body with most segments of full timelines, how short these are, and how long they would have to be; a sentence that follows
    /// another.
    /// </summary>
    internal string OfFullTimelines(SimDuration history)
    {
        int most = 0;
        int whose = 0;
        foreach (int slot in bodies)
        {
            int count = 0;
            for (int at = timelines.First(slot); at != TimelineStore.None; at = timelines.Next(at))
            {
                count++;
            }

            (most, whose) = count > most ? (count, slot) : (most, whose);
        }

        int last = timelines.Last(whose);
        if (most < 2 || last == TimelineStore.None)
        {
            return "";
        }

        double mean = timelines.Key(last).Time.SecondsSince(timelines.Key(timelines.First(whose)).Time) / (most - 1);
        double least = history.ToSeconds() / timelines.MaxSegments;
        ref readonly MotionSegment path = ref timelines.Segment(last);
        string rates = RatesOn(whose, path.Position, path.Velocity, timelines.SpinOf(last).AtEpoch);
        return $" Most are of {scene.Describe(bodies.Id(whose))}: {most}, of {Limits.Short(mean)} s in the mean; the history that is kept, {history.ToShortString()}, has room for"
            + $" pieces of {Limits.Short(least)} s."
            + (rates.Length > 0 ? $" On it {rates}." : "") + Jumps(bodies.Spec(whose));
    }
}
