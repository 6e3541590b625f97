using System.Globalization;
using LagSim.Scenes;

namespace LagSim;

/// <summary>Which law moves a body of a scene, why, and what that costs between events.</summary>
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

    /// <summary>Why that law, in a sentence; and, if it is so, why it cannot take a first step.</summary>
    public string Why { get; }

    /// <summary>
    /// The number of segments of its path in a simulated second where it starts, besides those that impacts open; 0: one segment from
    /// impact to impact. No number (<see cref="double.NaN"/>) if it cannot take a first step.
    /// </summary>
    public double SegmentsPerSecond { get; }

    /// <summary>
    /// How often its forces are evaluated in a simulated second where it starts; no number if it cannot take a first step.
    /// </summary>
    public double EvaluationsPerSecond { get; }

    /// <summary>
    /// One line: the body, its law, what that costs if it comes in pieces, and why; <c>ball: Ballistic. Only uniform gravity acts on it: a
    /// parabola is exact.</c>
    /// </summary>
    public override string ToString() =>
        SegmentsPerSecond == 0 || double.IsNaN(SegmentsPerSecond)
            ? $"{Body}: {Motion}. {Why}"
            : string.Format(
                CultureInfo.InvariantCulture, "{0}: {1}, {2:G3} pieces/s, {3:G3} force calls/s. {4}", Body, Motion, SegmentsPerSecond, EvaluationsPerSecond, Why);
}
