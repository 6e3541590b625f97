using System.Collections.Generic;

namespace LagSim.Harness.Experiments.Hands;

/// <summary>The errors of hand predictions at one horizon: rms over the motion, in metres. Immutable.</summary>
/// <param name="HorizonMilliseconds">The time from the newest sample to the predicted position, in milliseconds.</param>
/// <param name="Samples">The number of predictions.</param>
/// <param name="AdaptiveMetres">The error of the adaptive predictor.</param>
/// <param name="CandidateMetres">The error of each of its candidates, in its order.</param>
/// <param name="LinearMetres">The error of a linear predictor of 20 taps, cross-validated on this motion.</param>
/// <param name="LinearInSampleMetres">The error of a linear predictor fitted to all of this motion: a lower bound for linear predictors of
/// 20 taps.</param>
/// <param name="LowerBoundMetres">A L^2 / 2 with the largest acceleration A of this motion: no predictor can guarantee a smaller worst
/// case.</param>
public sealed record PredictionError(
    double HorizonMilliseconds,
    int Samples,
    double AdaptiveMetres,
    IReadOnlyList<double> CandidateMetres,
    double LinearMetres,
    double LinearInSampleMetres,
    double LowerBoundMetres)
{
    /// <summary>The error of holding the last position.</summary>
    public double HoldLastMetres => CandidateMetres[0];

    /// <summary>The error of extrapolating at the last velocity.</summary>
    public double VelocityMetres => CandidateMetres[PredictionTest.VelocityCandidate];

    /// <summary>The index of the candidate with the least error.</summary>
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

    /// <summary>The error of that candidate.</summary>
    public double BestInHindsightMetres => CandidateMetres[BestCandidate];

    /// <summary>
    /// The adaptive predictor's error divided by that of the best candidate in hindsight; NaN where both are 0, as at horizon 0.
    /// </summary>
    public double RatioToBest => AdaptiveMetres / BestInHindsightMetres;
}
