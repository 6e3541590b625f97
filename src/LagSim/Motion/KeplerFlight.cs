using System;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Motion;

/// <summary>Flight under one inverse-square pull alone, in closed form: ellipse, parabola or hyperbola.</summary>
/// <remarks>
/// <para>Kepler's equation in universal variables (Battin, An Introduction to the Mathematics and Methods of Astrodynamics, 4.5): with beta
/// = 2 mu / r - v² and the functions G of s, t = r G1 + (x.v) G2 + mu G3 is solved for s by Newton's method; then x(t) = f x + g v. One
/// formula for every eccentricity.</para>
/// <para>A segment is the quintic Hermite polynomial between two such states, within the body's tolerance of the orbit. It lasts a
/// tenth of the time in which the body could reach the centre or circle it, at most; in that time the sixth and seventh derivative grow by
/// less than four.</para>
/// </remarks>
internal readonly struct KeplerFlight
{
    private const double Rounding = 2.220446049250313e-16;
    private const double PartOfTime = 0.1;
    private const double Growth = 4;

    private readonly BodySpec spec;
    private readonly Vector3D centre;
    private readonly double mu;

    /// <summary>The flight of a body that <see cref="FlightLaws.IsKepler"/> is true of.</summary>
    internal KeplerFlight(Scene scene, in BodySpec spec)
    {
        this.spec = spec;
        Force pull = scene.ForceArray[spec.Forces.UpTo - 1];
        centre = pull.Vector;
        mu = pull.Strength;
    }

    /// <summary>A segment of the orbit from a state on.</summary>
    /// <param name="epoch">When it begins.</param>
    /// <param name="position">The position then.</param>
    /// <param name="velocity">The velocity then.</param>
    /// <param name="dense">The path's higher coefficients.</param>
    /// <param name="error">How many times too long the shortest possible segment would be, which must then not be used; zero
    /// otherwise.</param>
    internal MotionSegment Piece(SimTime epoch, in Vector3D position, in Vector3D velocity, out DenseOutput dense, out double error)
    {
        Vector3D x = position - centre;
        double r = x.Length;
        double length = Length(x, velocity, r);
        SimDuration step = StepSize.Scaled(StepSize.Longest, length);
        error = step == StepSize.Shortest ? StepSize.Shortest.ToSeconds() / length : 0;
        error = error > 1 ? error : 0;
        double h = step.ToSeconds();

        double eta = Vector3D.Dot(x, velocity);
        double beta = (2 * mu / r) - velocity.LengthSquared;
        double s = Solve(h, r, eta, beta, out UniversalFunctions g);
        double r1 = (r * g.Zeroth(beta)) + (eta * g.First(s, beta)) + (mu * g.Second);
        Vector3D dx = (x * (-mu * g.Second / r)) + (velocity * (h - (mu * g.Third)));
        Vector3D dv = (x * (-mu * g.First(s, beta) / (r * r1))) + (velocity * (-mu * g.Second / r1));
        Vector3D a = x * (-mu / (r * r * r));
        Vector3D a1 = (x + dx) * (-mu / (r1 * r1 * r1));
        dense = DenseOutput.Between(h, dx, dv, velocity, a, a1);
        return new MotionSegment(MotionLaw.ClosedForm, epoch, epoch + step, position, velocity, a);
    }

    /// <summary>
    /// The s that belongs to a time: the time is a growing function of s, with the distance as its slope, and nearly a straight line over a
    /// tenth of an orbit.
    /// </summary>
    private double Solve(double h, double r, double eta, double beta, out UniversalFunctions g)
    {
        double s = h / r;
        for (int i = 0; ; i++)
        {
            g = UniversalFunctions.Of(beta, s);
            double time = (r * g.First(s, beta)) + (eta * g.Second) + (mu * g.Third);
            double slope = (r * g.Zeroth(beta)) + (eta * g.First(s, beta)) + (mu * g.Second);
            double next = s - ((time - h) / slope);
            if (i == 8 || !(Math.Abs(next - s) > Rounding * s))
            {
                return s;
            }

            s = next;
        }
    }

    /// <summary>How long the segment may be, in seconds.</summary>
    private double Length(in Vector3D x, in Vector3D v, double r)
    {
        // The power series of the orbit by the recurrences of w = |x|² and u = mu w^(-3/2).
        const int terms = 8;
        Span<Vector3D> path = stackalloc Vector3D[terms];
        Span<double> w = stackalloc double[terms];
        Span<double> u = stackalloc double[terms];
        path[0] = x;
        path[1] = v;
        for (int n = 0; n + 2 < terms; n++)
        {
            w[n] = 0;
            for (int i = 0; i <= n; i++)
            {
                w[n] += Vector3D.Dot(path[i], path[n - i]);
            }

            double sum = 0;
            for (int k = 1; k <= n; k++)
            {
                sum += ((-0.5 * k) - n) * w[k] * u[n - k];
            }

            u[n] = n == 0 ? mu / (r * r * r) : sum / (n * w[0]);
            Vector3D pull = Vector3D.Zero;
            for (int i = 0; i <= n; i++)
            {
                pull += path[i] * u[n - i];
            }

            path[n + 2] = pull * (-1.0 / ((n + 1) * (n + 2)));
        }

        double most = PartOfTime * Math.Min(Math.Sqrt(r * r * r / mu), r / v.Length);
        return HermiteError.LongestStep(
            spec.Tolerance, (x + centre).Length + spec.Radius, v.Length, 2 * path[2].Length, Growth * 720 * path[6].Length, Growth * 5040 * path[7].Length, most);
    }
}
