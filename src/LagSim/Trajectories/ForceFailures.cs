using System.Text;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Trajectories;

/// <summary>The error messages for forces that are too strong for a step, or for the timelines.</summary>
internal sealed class ForceFailures(Scene scene, in Forces forces, BodyTable bodies, TimelineStore timelines)
{
    private readonly Forces forces = forces;

    /// <summary>Why no step from a state can be used.</summary>
    /// <param name="slot">The body.</param>
    /// <param name="from">When the step begins.</param>
    /// <param name="x">The position then.</param>
    /// <param name="v">The velocity then.</param>
    /// <param name="spin">How it turns.</param>
    /// <param name="tooStiff">The rate in 1/s that was met by fixed steps; zero if that is not why.</param>
    /// <param name="tooLarge">How many times the tolerance the error of the shortest step is, infinite if it has no number; zero if that
    /// is not why.</param>
    /// <param name="isFinite">Whether the acceleration at the state is.</param>
    internal SimulationException OfStep(
        int slot, SimTime from, in Vector3D x, in Vector3D v, in Vector3D spin, double tooStiff, double tooLarge, bool isFinite)
    {
        ref readonly BodySpec spec = ref bodies.Spec(slot);
        string where = $"From {from.ToShortString()} on, at {Limits.Short(x)} m and {Limits.Short(v)} m/s, the forces on {scene.Describe(bodies.Id(slot))}";
        foreach (Force force in spec.Forces.Among(scene.ForceArray))
        {
            if (force.Kind == ForceKind.Central && force.Power < 0 && x == force.Vector)
            {
                return new SimulationException(
                    $"{where} have no value: it is at the centre of '{force.Name}', whose power is {force.Power}; start it, or put it, elsewhere.");
            }
        }

        if (!isFinite || (double.IsPositiveInfinity(tooLarge) && forces.HasSupplied(spec)) || (tooStiff == 0 && tooLarge == 0))
        {
            return new SimulationException(
                $"In the step from {from.ToShortString()}, at {Limits.Short(x)} m and {Limits.Short(v)} m/s, the acceleration of {scene.Describe(bodies.Id(slot))} became NaN or "
                + $"infinite; what the forces {spec.Forces.NamesAmong(scene.ForceArray)} give must be finite.");
        }

        string rates = RatesOn(slot, x, v, spin);
        if (tooStiff > 0)
        {
            double most = FlightLaws.MaxStableRate(spec);
            string what = ActTooFast(forces.FixedStepRateAt(spec, x, v, spin), tooStiff, most);
            return new SimulationException(
                $"{where} {what}: there {rates}. {spec.Flight} with fixed steps follows at most {Limits.Short(most)} 1/s, by steps halved to "
                + $"{Limits.Short(FlightLaws.ShortestStep(spec).ToSeconds())} s. Make them weaker, or use Automatic.");
        }

        return new SimulationException(
            $"{where} change so fast that a step of {Limits.Short(StepSize.Shortest.ToSeconds())} s, the shortest there is, still has "
            + $"{Limits.Short(tooLarge)} times the error of the tolerance, {Limits.Text(spec.Tolerance)}: there {rates}. "
            + $"Allow a larger error, make them weaker, or keep it out of the singularity, if there is one.{Jumps(spec)}");
    }

    /// <summary>Why no contact step can be taken: forces act too fast on a member even for the shortest there is.</summary>
    internal SimulationException OfContactStep(int slot, SimTime from, in Vector3D x, in Vector3D v, in Vector3D spin, double rate)
    {
        double most = 1 / SimDuration.FromTicks(Contacts.ContactScale.ShortestTicks).ToSeconds();
        return new SimulationException(
            $"From {from.ToShortString()} on, at {Limits.Short(x)} m and {Limits.Short(v)} m/s, the forces on {scene.Describe(bodies.Id(slot))}, which touches something, "
            + $"{ActTooFast(rate, rate, most)}: there {RatesOn(slot, x, v, spin)}. What is in persistent contact moves by steps that follow at most"
            + $" {Limits.Short(most)} 1/s, halved to {Limits.Short(1 / most)} s. Make them weaker, or the body heavier.");
    }

    private static string ActTooFast(double here, double met, double most) =>
        here > most ? $"act at a rate of {Limits.Short(here)} 1/s" : $"lead in a step to where they act at a rate of {Limits.Short(met)} 1/s";

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
