using System;
using System.Collections.Generic;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Display;

/// <summary>
/// Predicts where a remote hand is now from samples as old as the link's delay: several predictors, weighted by how each has recently done
/// over that very span.
/// </summary>
/// <remarks>
/// <para>For display only: the prediction depends on when the samples arrived, so it differs from peer to peer and must never enter a
/// simulation.</para>
/// <para>The candidates are: hold (the hand stays), velocity that decays with a time constant of 20, 40, 80, 160 or 320 ms, constant
/// velocity, and least squares over the last 200 ms that learn online. Each new sample is compared with what each candidate would have
/// predicted from samples as old as now; that error, squared and forgotten within a second or two, gives the weights. So there is nothing
/// to tune: a calm hand is followed, a shaken one is not.</para>
/// <para>What to expect: on generated hand motion the rms error stays within 1.15 of that of the best candidate in hindsight. Nothing can
/// promise an error below A L^2 / 2 for a hand that may accelerate by A (m/s^2) since its newest sample, L seconds ago: see
/// <see cref="ErrorLowerBound"/>.</para>
/// <para>It remembers 512 samples, so it can learn for spans up to what those cover. Memory is fixed; nothing is allocated after
/// construction. A sample costs some ten microseconds, a prediction far less; when the span changes for good by a quarter or more, one
/// prediction reprocesses all it remembers. Not thread-safe.</para>
/// </remarks>
public sealed class AdaptivePredictor
{
    /// <summary>The number of samples remembered.</summary>
    public const int RememberedSamples = 512;

    private const int Damped = 5;
    private const int Velocity = Damped + 1;
    private const int Learned = Velocity + 1;

    private const double ErrorMemory = 0.8; // s, to 1/e
    private const double LearningMemory = 4; // s, to 1/e
    private const double Sharpness = 8; // a quarter more squared error is e^-2 of the weight
    private const double ErrorFloor = 1e-8; // m^2: below a tenth of a millimetre all are equally good
    private const double HorizonMemory = 0.5; // s, to 1/e
    private const double HorizonTolerance = 0.25;

    private static readonly double[] TimeConstants = { 0.020, 0.040, 0.080, 0.160, 0.320 };

    private static readonly SimDuration[] LookBacks =
    {
        SimDuration.FromSeconds(0.025), SimDuration.FromSeconds(0.05), SimDuration.FromSeconds(0.1), SimDuration.FromSeconds(0.2),
    };

    private readonly HandHistory history = new(RememberedSamples);
    private readonly OnlineLeastSquares leastSquares = new();
    private readonly Vector3D[] inputs = new Vector3D[OnlineLeastSquares.Inputs];
    private readonly double[] errors = new double[Learned + 1];
    private readonly double[] weights = new double[Learned + 1];
    private SimDuration horizon; // the span that errors and weights apply to
    private double askedSeconds; // the mean span that is asked for
    private SimTime lastAsked;
    private bool wasAsked;

    /// <summary>Creates a predictor without samples.</summary>
    public AdaptivePredictor() => Forget();

    /// <summary>The names of the candidates, in the order of <see cref="WeightOf"/>.</summary>
    public static IReadOnlyList<string> Candidates { get; } =
        Array.AsReadOnly(new[] { "hold", "damped 20 ms", "damped 40 ms", "damped 80 ms", "damped 160 ms", "damped 320 ms", "velocity", "least squares" });

    /// <summary>The longest span beyond the newest sample for a prediction; a later time gets the prediction for that span.</summary>
    public static SimDuration MaxHorizon { get; } = SimDuration.FromSeconds(1);

    /// <summary>Whether there is a sample; before that nothing can be predicted.</summary>
    public bool HasSamples => history.Count > 0;

    /// <summary>The time of the newest sample.</summary>
    /// <exception cref="InvalidOperationException">There is no sample.</exception>
    public SimTime NewestSample => HasSamples ? history.Newest.Time : throw new InvalidOperationException("This predictor has heard no sample.");

    /// <summary>
    ///  The least error in metres that any predictor can promise for a hand that accelerates by at most <paramref name="acceleration"/>
    /// (m/s^2, at least 0), <paramref name="delay"/> (at least 0) after its newest sample: A L^2 / 2.
    /// </summary>
    /// <remarks>
    /// Two hands that moved the same up to that sample can part with acceleration A in opposite directions, and be A L^2 apart. Any
    /// prediction is wrong by half of that for one of them.
    /// </remarks>
    /// <exception cref="ArgumentOutOfRangeException">A value is negative or not finite.</exception>
    public static double ErrorLowerBound(double acceleration, SimDuration delay)
    {
        if (!(acceleration >= 0) || double.IsInfinity(acceleration))
        {
            throw new ArgumentOutOfRangeException(nameof(acceleration), acceleration, "The acceleration must be finite and at least 0 m/s^2.");
        }

        if (delay < SimDuration.Zero)
        {
            throw new ArgumentOutOfRangeException(nameof(delay), delay.ToShortString(), "The delay must be at least zero.");
        }

        double seconds = delay.ToSeconds();
        return acceleration * seconds * seconds / 2;
    }

    /// <summary>The weight of a candidate in predictions, 0 to 1; all add up to 1.</summary>
    /// <param name="candidate">Its place in <see cref="Candidates"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such candidate.</exception>
    public double WeightOf(int candidate) => weights[Checked(candidate)];

    /// <summary>Adds a sample of the hand.</summary>
    /// <param name="time">When the hand was there.</param>
    /// <param name="position">Metres, finite.</param>
    /// <param name="velocity">Metres per second, finite, as measured by the sender.</param>
    /// <returns>False if it is not newer than the newest; nothing changed then.</returns>
    /// <exception cref="ArgumentOutOfRangeException">A value is not finite; nothing changed.</exception>
    public bool Add(SimTime time, Vector3D position, Vector3D velocity)
    {
        if (!position.IsFinite)
        {
            throw new ArgumentOutOfRangeException(nameof(position), position, "Every component of a hand's position must be finite.");
        }

        if (!velocity.IsFinite)
        {
            throw new ArgumentOutOfRangeException(nameof(velocity), velocity, "Every component of a hand's velocity must be finite.");
        }

        if (HasSamples && time <= history.Newest.Time)
        {
            return false;
        }

        history.Add(time, position, velocity);
        Learn(history.Count - 1);
        return true;
    }

    /// <summary>Predicts where the hand is.</summary>
    /// <param name="now">
    /// The time. At or before the newest sample the result is where the hand was, on a straight line between two samples.
    /// </param>
    /// <param name="position">Metres.</param>
    /// <returns>False if there is no sample, or <paramref name="now"/> is before all that is remembered.</returns>
    public bool TryPredict(SimTime now, out Vector3D position)
    {
        if (!HasSamples || now <= history.Newest.Time)
        {
            return history.TryPositionAt(now, out position);
        }

        Aim(now);
        double seconds = SecondsAfterNewest(now);
        ref readonly HandHistory.Sample newest = ref history.Newest;
        Vector3D way = default;
        for (int candidate = 0; candidate < weights.Length; candidate++)
        {
            way += Way(newest, candidate, seconds) * weights[candidate];
        }

        position = newest.Position + way;
        return true;
    }

    /// <summary>Predicts with one candidate alone, for comparison. Changes nothing, not even the span that is learned for.</summary>
    /// <param name="now">The time.</param>
    /// <param name="candidate">Its place in <see cref="Candidates"/>.</param>
    /// <param name="position">Metres.</param>
    /// <returns>As <see cref="TryPredict(SimTime, out Vector3D)"/>.</returns>
    /// <exception cref="ArgumentOutOfRangeException">There is no such candidate.</exception>
    public bool TryPredict(SimTime now, int candidate, out Vector3D position)
    {
        Checked(candidate);
        if (!HasSamples || now <= history.Newest.Time)
        {
            return history.TryPositionAt(now, out position);
        }

        position = history.Newest.Position + Way(history.Newest, candidate, SecondsAfterNewest(now));
        return true;
    }

    private double SecondsAfterNewest(SimTime now) => Math.Min(HandHistory.Seconds(history.Newest.Time, now), MaxHorizon.ToSeconds());

    /// <summary>The instant that much earlier, or the first there is.</summary>
    private static SimTime Before(SimTime time, SimDuration span) => time > SimTime.MinValue + span ? time - span : SimTime.MinValue;

    private static int Checked(int candidate) => candidate >= 0 && candidate <= Learned
        ? candidate
        : throw new ArgumentOutOfRangeException(nameof(candidate), candidate, $"There are candidates 0 to {Learned}.");

    /// <summary>The displacement that a candidate predicts from a sample on.</summary>
    private static Vector3D Way(in HandHistory.Sample from, int candidate, double seconds) => candidate switch
    {
        0 => Vector3D.Zero,
        <= Damped => from.Velocity * (TimeConstants[candidate - 1] * (1 - Math.Exp(-seconds / TimeConstants[candidate - 1]))),
        Velocity => from.Velocity * seconds,
        _ => from.Learned * seconds,
    };

    /// <summary>Keeps the learned span near the requested one. A single frame more or less is not worth relearning.</summary>
    private void Aim(SimTime now)
    {
        double seconds = SecondsAfterNewest(now);
        if (!wasAsked)
        {
            askedSeconds = seconds;
            wasAsked = true;
        }
        else if (now > lastAsked)
        {
            askedSeconds += (seconds - askedSeconds) * (1 - Math.Exp(-HandHistory.Seconds(lastAsked, now) / HorizonMemory));
        }

        lastAsked = now;
        if (Math.Abs(askedSeconds - horizon.ToSeconds()) > HorizonTolerance * horizon.ToSeconds())
        {
            Forget();
            horizon = SimDuration.FromSeconds(askedSeconds);
            for (int n = 0; n < history.Count; n++)
            {
                Learn(n);
            }
        }
    }

    private void Forget()
    {
        leastSquares.Clear();
        Array.Clear(errors, 0, errors.Length);
        for (int candidate = 0; candidate < weights.Length; candidate++)
        {
            weights[candidate] = 1.0 / weights.Length;
        }
    }

    /// <summary>Learns from sample <paramref name="n"/> what was predictable from the samples up to the horizon before it.</summary>
    private void Learn(int n)
    {
        ref HandHistory.Sample sample = ref history[n];
        int known = horizon > SimDuration.Zero ? history.LastAt(Before(sample.Time, horizon)) : -1;
        if (known >= 0 && known < n)
        {
            double sinceLast = HandHistory.Seconds(history[n - 1].Time, sample.Time);
            Validate(history[known], sample, Math.Exp(-sinceLast / ErrorMemory));
            leastSquares.Fade(Math.Exp(-sinceLast / LearningMemory));
            if (TryInputs(known))
            {
                ref readonly HandHistory.Sample from = ref history[known];
                leastSquares.Learn(inputs, (sample.Position - from.Position) / HandHistory.Seconds(from.Time, sample.Time));
            }
        }

        sample.Learned = TryInputs(n) ? leastSquares.Predict(inputs) : Vector3D.Zero;
    }

    private void Validate(in HandHistory.Sample from, in HandHistory.Sample came, double kept)
    {
        double seconds = HandHistory.Seconds(from.Time, came.Time);
        double least = double.MaxValue;
        for (int candidate = 0; candidate < errors.Length; candidate++)
        {
            double error = (from.Position + Way(from, candidate, seconds) - came.Position).LengthSquared;
            errors[candidate] = (errors[candidate] * kept) + error + ErrorFloor;
            least = Math.Min(least, errors[candidate]);
        }

        double sum = 0;
        for (int candidate = 0; candidate < errors.Length; candidate++)
        {
            weights[candidate] = Math.Exp(-Sharpness * ((errors[candidate] / least) - 1));
            sum += weights[candidate];
        }

        for (int candidate = 0; candidate < errors.Length; candidate++)
        {
            weights[candidate] /= sum;
        }
    }

    /// <summary>Computes the velocities at a sample and over some spans before it; false if the history is too short.</summary>
    private bool TryInputs(int n)
    {
        ref readonly HandHistory.Sample sample = ref history[n];
        inputs[0] = sample.Velocity;
        for (int i = 0; i < LookBacks.Length; i++)
        {
            if (!history.TryPositionAt(Before(sample.Time, LookBacks[i]), out Vector3D before))
            {
                return false;
            }

            inputs[i + 1] = (sample.Position - before) / LookBacks[i].ToSeconds();
        }

        return true;
    }
}
