using System.Collections.Generic;
using System.Globalization;
using System.Text;
using LagSim.Contacts;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim;

/// <summary>
/// An explanation of what the engine simulates for a scene, what it leaves out, and why: a scene pays only for what it uses.
/// </summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class SceneExplanation
{
    private const int MaxGroupsInText = 10;
    private const int MaxNamesInText = 3;

    private SceneExplanation(IReadOnlyList<BodyExplanation> bodies, IReadOnlyList<FeatureExplanation> features, string? cannotBegin)
    {
        Bodies = bodies;
        Features = features;
        CannotBegin = cannotBegin;
    }

    /// <summary>The bodies, in the order of the scene.</summary>
    public IReadOnlyList<BodyExplanation> Bodies { get; }

    /// <summary>All features that can be modelled, always the same in the same order.</summary>
    public IReadOnlyList<FeatureExplanation> Features { get; }

    /// <summary>Why no world of the scene can begin, in the words of <see cref="Simulation"/>'s exception; null: one can.</summary>
    public string? CannotBegin { get; }

    /// <summary>
    /// A line for all bodies that have the same law for the same reason at the same cost, in the order of the first of them, of at most ten
    /// such groups, a line for each thing that can be modelled, and why no world can begin, if none can; lines end with LF everywhere.
    /// </summary>
    public override string ToString()
    {
        List<(string Line, List<string> Names)> groups = new();
        int untold = 0;
        foreach (BodyExplanation body in Bodies)
        {
            string line = body.ToString().Substring(body.Body.Length);
            int group = groups.FindIndex(g => g.Line == line);
            if (group >= 0)
            {
                groups[group].Names.Add(body.Body);
            }
            else if (groups.Count < MaxGroupsInText)
            {
                groups.Add((line, new List<string> { body.Body }));
            }
            else
            {
                untold++;
            }
        }

        StringBuilder text = new();
        foreach ((string line, List<string> names) in groups)
        {
            int named = names.Count <= MaxNamesInText + 1 ? names.Count : MaxNamesInText; // "and 1 more" is as long as a name
            text.Append(string.Join(", ", names.GetRange(0, named)));
            text.Append(named < names.Count ? $" and {names.Count - named} more" : "").Append(line).Append('\n');
        }

        if (untold > 0)
        {
            text.Append("and ").Append(Count(untold, "more body", "more bodies")).Append('\n');
        }

        for (int i = 0; i < Features.Count; i++)
        {
            text.Append(Features[i].ToString()).Append(i + 1 < Features.Count ? "\n" : "");
        }

        return CannotBegin is null ? text.ToString() : text.Append("\nno world can begin: ").Append(CannotBegin).ToString();
    }

    internal static SceneExplanation Of(Scene scene)
    {
        string?[] obstacles = new string?[scene.BodyArray.Length];
        string? cannotBegin = null;
        Engine start;
        try
        {
            start = new Simulation(scene).Engine;
        }
        catch (SimulationException failure)
        {
            cannotBegin = failure.Message;
            start = FlightsAlone(scene, obstacles);
        }

        List<BodyExplanation> bodies = new();
        for (int i = 0; i < scene.BodyArray.Length; i++)
        {
            ref readonly SceneBody body = ref scene.BodyArray[i];
            bodies.Add(
                obstacles[i] is string obstacle
                    ? new BodyExplanation(body.Name, body.Spec.Flight, $"{Why(scene, body.Spec)} Its first step cannot be taken. {obstacle}", double.NaN, double.NaN)
                    : OfBody(scene, body, start, start.Timelines.Last(start.Bodies.SlotOf(BodyId.OfScene(i)))));
        }

        return new SceneExplanation(bodies, FeaturesOf(scene), cannotBegin);
    }

    /// <summary>
    /// A scene's bodies on the first segments of their flights, of which none meets anything: where a world of the scene cannot begin.
    /// </summary>
    /// <param name="scene">The scene.</param>
    /// <param name="obstacles">Of each body why it cannot take a step; null where it can.</param>
    private static Engine FlightsAlone(Scene scene, string?[] obstacles)
    {
        SimulationOptions options = new();
        Engine flights = new(scene, options, options.Start, options.Start, scene.BodyArray.Length);
        for (int i = 0; i < scene.BodyArray.Length; i++)
        {
            try
            {
                flights.Roster.AddFromScene(i);
            }
            catch (SimulationException failure)
            {
                obstacles[i] = failure.Message;
            }
        }

        return flights;
    }

    private static BodyExplanation OfBody(Scene scene, in SceneBody body, Engine start, int piece)
    {
        BodySpec spec = body.Spec;
        ref readonly MotionSegment first = ref start.Timelines.Segment(piece);
        SimDuration next = start.Timelines.Dense(piece).NextStep; // under error control the first step is but a try
        double length = next == SimDuration.Zero ? first.End.SecondsSince(first.Epoch) : next.ToSeconds();
        bool isInPieces = first.IsDense || (scene.Box.Exists && first.End != SimTime.MaxValue);
        double perSecond = isInPieces ? 1 / length : 0;
        int evaluations = spec.Flight switch
        {
            MotionLaw.RungeKutta4 => 5,
            MotionLaw.DormandPrince54 => 7,
            MotionLaw.ClosedForm => 1,
            _ => 0,
        };
        return new BodyExplanation(body.Name, spec.Flight, Why(scene, spec) + Full(perSecond), perSecond, perSecond * evaluations);
    }

    private static string Why(Scene scene, in BodySpec spec)
    {
        BodySpec free = spec.With(MotionLaw.Automatic);
        MotionLaw cheapest = FlightLaws.Chosen(free, scene.Gravity, scene.ForceArray);
        string exact = cheapest switch
        {
            MotionLaw.Ballistic => scene.Gravity == Vector3D.Zero
                ? "No force acts on it: a straight line is exact."
                : "Only uniform gravity acts on it: a parabola is exact.",
            MotionLaw.ClosedForm when FlightLaws.AreLinear(spec, scene.ForceArray) =>
                $"{Names(scene, spec)}: linear in position and velocity, so there is a closed form.",
            MotionLaw.ClosedForm => $"{Names(scene, spec)}: one inverse-square pull alone, so there is a closed form, Kepler's.",
            _ => $"{Names(scene, spec)}: together without a closed form here, so steps whose error is kept within {Text(spec.Tolerance)} m.",
        };
        return spec.Flight == cheapest
            ? cheapest == MotionLaw.DormandPrince54 && spec.Tolerance == 0
                ? $"{Names(scene, spec)}: without a closed form here; with a tolerance of 0 the scene asks for fixed steps."
                : exact
            : $"The scene asks for {spec.Flight}. {cheapest} would be cheaper: {char.ToLowerInvariant(exact[0])}{exact.Substring(1)}";
    }

    /// <summary>The warning for a path that by itself has more segments than timelines hold by default.</summary>
    private static string Full(double perSecond) =>
        perSecond * SimulationOptions.DefaultHistory.ToSeconds() <= SimulationOptions.DefaultMaxSegments
            ? ""
            : $" So many pieces that the timelines are full before the history of {SimulationOptions.DefaultHistory.ToShortString()} is, at"
                + $" {Text(SimulationOptions.DefaultMaxSegments)}, unless they become longer: keep a shorter history, allow more, or make the forces weaker.";

    private static string Names(Scene scene, in BodySpec spec)
    {
        List<string> names = new();
        foreach (Force force in spec.Forces.Among(scene.ForceArray))
        {
            names.Add($"{force.Name} ({force.Kind})");
        }

        return (scene.Gravity == Vector3D.Zero ? "" : "Gravity, ") + string.Join(", ", names);
    }

    private static IReadOnlyList<FeatureExplanation> FeaturesOf(Scene scene)
    {
        int inPieces = 0;
        int closed = 0;
        uint used = 0;
        foreach (SceneBody body in scene.BodyArray)
        {
            inPieces += body.Spec.Flight is MotionLaw.RungeKutta4 or MotionLaw.DormandPrince54 ? 1 : 0;
            closed += body.Spec.Flight is MotionLaw.ClosedForm ? 1 : 0;
            used |= body.Spec.Forces.Mask;
        }

        int bodies = scene.BodyArray.Length;
        List<string> idle = new();
        for (int n = 0; n < scene.ForceArray.Length; n++)
        {
            if (!ForceSet.FromMask(used).Contains(n))
            {
                idle.Add(scene.ForceArray[n].Name);
            }
        }

        bool hasIndex = bodies > SimulationOptions.DefaultBruteForceLimit;
        bool canLast = scene.PlaneArray.Length > 0 && scene.Gravity != Vector3D.Zero;
        FeatureExplanation islands = Islands(scene, used != 0);
        return new[]
        {
            new FeatureExplanation(
                "forces besides gravity", used != 0,
                (used != 0 ? $"{Count(scene.ForceArray.Length - idle.Count, "force")} on bodies that name them." : "No body names one.") + Idle(idle)),
            new FeatureExplanation(
                "integrator", inPieces > 0,
                inPieces > 0
                    ? $"{Count(inPieces, "body", "bodies")} of {bodies} in steps."
                    : $"Every path has a closed form{(closed > 0 ? $", {closed} of {bodies} in pieces of degree five" : "")}."),
            SpinAndFriction(scene),
            new FeatureExplanation(
                "rest on planes", canLast,
                canLast
                    ? "Planes under gravity: bounces below the restitution threshold end in sliding or rest, which cost nothing."
                    : "There is no plane, or no gravity to press on it."),
            islands,
            new FeatureExplanation("contact tolerance", islands.IsModelled, Tolerance(scene)),
            new FeatureExplanation(
                "static geometry", scene.PlaneArray.Length + scene.SphereArray.Length > 0,
                scene.PlaneArray.Length + scene.SphereArray.Length > 0
                    ? $"{Count(scene.PlaneArray.Length, "plane")}, {Count(scene.SphereArray.Length, "static sphere")}: each is asked for every piece of path."
                    : "There is none."),
            new FeatureExplanation(
                "contacts of bodies", bodies > 1 || scene.Spawners != PeerSet.Nobody,
                hasIndex
                    ? $"{bodies} bodies. Above {SimulationOptions.DefaultBruteForceLimit}, neighbour lists: only pairs that come near are tested."
                    : $"{Count(bodies, "body", "bodies")}. Up to {SimulationOptions.DefaultBruteForceLimit}, brute force: every pair is tested."),
            new FeatureExplanation(
                "periodic box", scene.Box.Exists, scene.Box.Exists ? "A flight is opened anew after an eighth of the least side." : "The scene has none."),
            new FeatureExplanation(
                "sensors", scene.SensorArray.Length > 0,
                scene.SensorArray.Length > 0
                    ? $"{Count(scene.SensorArray.Length, "sensor")}: each is asked for every piece of path, and changes none."
                    : "There is none."),
            new FeatureExplanation(
                "rules", scene.Rules is not null,
                scene.Rules is SceneRules rules ? $"'{rules}', written in C#: they are called for the events that they hear of." : "The scene has none."),
        };
    }

    private static FeatureExplanation SpinAndFriction(Scene scene)
    {
        int rough = 0;
        int turning = 0;
        foreach (SceneBody body in scene.BodyArray)
        {
            rough += body.Spec.Friction > 0 ? 1 : 0;
            turning += body.Spin != Vector3D.Zero ? 1 : 0;
        }

        string why = rough > 0
            ? $"{Count(rough, "body", "bodies")} of {scene.BodyArray.Length} with friction: impacts turn them, on planes they slip, roll and rest."
            : turning > 0
            ? $"{Count(turning, "body", "bodies")} of {scene.BodyArray.Length} turning from the start, evenly and for ever, since none has friction."
            : "No body has friction or turns at the start, so nothing turns but what is spawned so.";
        return new FeatureExplanation("spin and friction", rough + turning > 0, why);
    }

    /// <summary>The bodies that may come to move with others by common steps, because no closed form carries them.</summary>
    private static FeatureExplanation Islands(Scene scene, bool isForced)
    {
        bool isRough = false;
        foreach (SceneBody body in scene.BodyArray)
        {
            isRough |= body.Spec.Friction > 0;
        }

        bool isPressed = scene.Gravity != Vector3D.Zero || isForced;
        bool canTouch = scene.BodyArray.Length > 1 || scene.SphereArray.Length > 0 || (isForced && scene.PlaneArray.Length > 0)
            || (isRough && scene.PlaneArray.Length > 1);
        bool isModelled = isPressed && canTouch && !scene.Box.Exists;
        int perSecond = (int)(SimDuration.TicksPerSecond / new ContactScale(scene.ContactTolerance, scene.Gravity, default).Step.Ticks);
        string moves = $"Bodies in persistent contact{(isRough ? ", with friction," : "")} that no closed form carries are moved together, by steps of at most"
            + $" 1/{perSecond} s."
            + $" That is {perSecond} pieces/s or more for each, every step solved for all of them at once, until they rest; then it costs nothing."
            + (isRough ? "" : " Without friction a heap may sway for long.");
        return new FeatureExplanation(
            "islands", isModelled,
            isModelled ? moves
                : !isPressed ? "Nothing presses bodies on each other or on anything."
                : scene.PlaneArray.Length == 0 ? "There is nothing that a body could lean on."
                : "There is nothing that a body could lean on but planes that carry it by a closed form.");
    }

    /// <summary>The one number that decides speed against error in heaps, and where it comes from.</summary>
    private static string Tolerance(Scene scene)
    {
        double tolerance = scene.ContactTolerance;
        string why = tolerance != SceneBuilder.DefaultContactTolerance(scene.SmallestRadius) ? "as the scene sets it"
            : tolerance < SceneBuilder.MaxDefaultContactTolerance
            ? $"the default: a hundredth of the smallest radius, {Text(scene.SmallestRadius)} m"
            : $"the default where the smallest radius is {Text(100 * SceneBuilder.MaxDefaultContactTolerance)} m or more";
        return $"{Text(tolerance)} m, {why}.";
    }

    private static string Idle(List<string> idle) => idle.Count == 0 ? "" : $" On no body of the scene: {string.Join(", ", idle)}.";

    private static string Count(int count, string one, string? many = null) => Limits.Count(count, one, many);

    private static string Text(double value) => value.ToString("R", CultureInfo.InvariantCulture);
}
