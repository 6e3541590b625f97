using LagSim.Scenes;

namespace LagSim;

/// <summary>How one body of a scene is moved, why so, and what that costs while nothing happens to it.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class BodyExplanation
{
    internal BodyExplanation(string body, MotionLaw motion, string why, double segmentsPerSecond, double evaluationsPerSecond)
    {
        Body = body;
        Motion = motion;
        Why = why;
        SegmentsPerSecond = segmentsPerSecond;
        EvaluationsPerSecond = evaluationsPerSecond;
    }

    /// <summary>The body's name.</summary>
    public string Body { get; }

    /// <summary>Its law of flight.</summary>
    public MotionLaw Motion { get; }

    /// <summary>Why that law, in a sentence.</summary>
    public string Why { get; }

    /// <summary>How many pieces its path has in a simulated second where it starts, besides those that impacts open; 0: one piece from impact to impact.</summary>
    public double SegmentsPerSecond { get; }

    /// <summary>How often its forces are evaluated in a simulated second where it starts.</summary>
    public double EvaluationsPerSecond { get; }
}
