using System.Collections.Generic;

namespace LagSim.Harness.Experiments.Hands;

/// <summary>How far predictions of a hand were off at one horizon: rms over the motion, in metres. Immutable.</summary>
/// <param name="HorizonMilliseconds">How long after the newest sample the hand was told.</param>
/// <param name="Samples">How many predictions were made.</param>
/// <param name="AdaptiveMetres">Of the adaptive predictor.</param>
/// <param name="CandidateMetres">Of each that it mixes, in its order.</param>
/// <param name="LinearMetres">Of a linear predictor of 20 taps, fitted to this very motion but for the tenth that it is asked
/// about.</param>
/// <param name="LinearInSampleMetres">The same, fitted to all of it: no linear predictor of 20 taps does better on this motion.</param>
/// <param name="MinWorstMetres">A L^2 / 2 with the largest acceleration of this motion: below that no predictor can promise to
/// stay.</param>
public sealed record PredictionError(
    double HorizonMilliseconds,
    int Samples,
    double AdaptiveMetres,
    IReadOnlyList<double> CandidateMetres,
    double LinearMetres,
    double LinearInSampleMetres,
    double MinWorstMetres)
{
    /// <summary>Of holding the last sample.</summary>
    public double HoldLastMetres => CandidateMetres[0];

    /// <summary>Of going on at the last sample's velocity.</summary>
    public double VelocityMetres => CandidateMetres[PredictionTest.VelocityCandidate];

    /// <summary>Which candidate turned out to be best.</summary>
    public int BestCandidate
    {
        get
        {
            int best = 0;
            for (int candidate = 1; candidate < CandidateMetres.Count; candidate++)
            {
                best = CandidateMetres[candidate] < CandidateMetres[best] ? candidate : best;
            }

            return best;
        }
    }

    /// <summary>Of that one.</summary>
    public double BestInHindsightMetres => CandidateMetres[BestCandidate];

    /// <summary>The adaptive predictor's error over that of the best in hindsight; NaN where neither errs, as at horizon 0.</summary>
    public double RatioToBest => AdaptiveMetres / BestInHindsightMetres;
}
