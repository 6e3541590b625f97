using System.Collections.Generic;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Experiments.Hands;

/// <summary>A sequence of strokes that may overlap. They are added up and sampled, with a tremor on top.</summary>
internal sealed class StrokeSequence
{
    private readonly List<MinimumJerkStroke> strokes = [];

    /// <summary>The position after the strokes so far, in metres.</summary>
    internal Vector3D Goal { get; private set; }

    /// <summary>Adds a stroke, in seconds and metres; no earlier than the one added before.</summary>
    internal void Add(double start, double duration, in Vector3D way)
    {
        strokes.Add(new MinimumJerkStroke(start, duration, way));
        Goal += way;
    }

    internal HandMotion Sample(string name, double seconds, SeededRandom tremorLuck)
    {
        Vector3D[] positions = new Vector3D[(int)(seconds * HandMotion.RateHertz) + 1];
        HandTremor tremor = new(tremorLuck);
        Vector3D done = Vector3D.Zero;
        int first = 0;
        for (int n = 0; n < positions.Length; n++)
        {
            double time = n / (double)HandMotion.RateHertz;
            while (first < strokes.Count && strokes[first].End <= time)
            {
                done += strokes[first++].Way;
            }

            Vector3D at = done + tremor.Next();
            for (int i = first; i < strokes.Count && strokes[i].Start < time; i++)
            {
                at += strokes[i].At(time);
            }

            positions[n] = at;
        }

        return new HandMotion(name, positions);
    }
}
