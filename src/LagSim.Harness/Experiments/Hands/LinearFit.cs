using System;
using LagSim.Scenes;
using MathNet.Numerics.LinearAlgebra;
using MathNet.Numerics.LinearAlgebra.Factorization;

namespace LagSim.Harness.Experiments.Hands;

/// <summary>The best linear predictor of 20 taps for a motion, by least squares on the motion itself.</summary>
/// <remarks>
/// <para>Each coordinate has taps of its own. They weigh the 20 newest positions and add up to 1, so that the answer does not depend on
/// where the origin is. Holding, constant velocity and damped velocity are such predictors, with a velocity that is the difference of the
/// two newest samples.</para>
/// <para>Fitted to all of the motion, its error is a lower bound for every linear predictor of 20 taps. Cross-validated, each tenth of the
/// motion is predicted by taps fitted to the rest, without the samples that overlap it, so nothing is fitted to its own test data.</para>
/// </remarks>
internal sealed class LinearFit
{
    internal const int Taps = 20;

    private const int Folds = 10;
    private const double LeastOfLargest = 1e-13; // smaller eigenvalues are rounding

    private LinearFit(double inSample, double crossValidated)
    {
        InSampleMetres = inSample;
        CrossValidatedMetres = crossValidated;
    }

    /// <summary>The rms error with taps fitted to all of the motion.</summary>
    internal double InSampleMetres { get; }

    /// <summary>The rms error with cross-validated taps.</summary>
    internal double CrossValidatedMetres { get; }

    /// <summary>Fits taps for the displacement from each sample to a number of samples later.</summary>
    internal static LinearFit Of(HandMotion motion, int steps)
    {
        int count = motion.Count - steps - (Taps - 1);
        double inSample = 0, crossValidated = 0;
        foreach (Func<Vector3D, double> axis in new Func<Vector3D, double>[] { v => v.X, v => v.Y, v => v.Z })
        {
            Equations all = new(motion, axis, steps);
            all.Add(0, count, 1);
            inSample += all.SquaredError(all.Solve(), 0, count);
            for (int fold = 0; fold < Folds; fold++)
            {
                int from = fold * count / Folds, to = (fold + 1) * count / Folds;
                int overlap = steps + Taps;
                Equations others = all.Copy();
                others.Add(Math.Max(from - overlap, 0), Math.Min(to + overlap, count), -1);
                crossValidated += others.SquaredError(others.Solve(), from, to);
            }
        }

        return new LinearFit(Math.Sqrt(inSample / count), Math.Sqrt(crossValidated / count));
    }

    /// <summary>
    /// The normal equations of one coordinate: the way from the newest sample on, out of the ways from the newest to each older one.
    /// </summary>
    private sealed class Equations
    {
        private const int Unknowns = Taps - 1;

        private readonly double[] line;
        private readonly int steps;
        private readonly Matrix<double> moments = Matrix<double>.Build.Dense(Unknowns, Unknowns);
        private readonly Vector<double> products = Vector<double>.Build.Dense(Unknowns);

        internal Equations(HandMotion motion, Func<Vector3D, double> axis, int steps)
        {
            line = new double[motion.Count];
            for (int n = 0; n < line.Length; n++)
            {
                line[n] = axis(motion.PositionAt(n));
            }

            this.steps = steps;
        }

        private Equations(Equations other)
        {
            line = other.line;
            steps = other.steps;
            moments = other.moments.Clone();
            products = other.products.Clone();
        }

        internal Equations Copy() => new(this);

        internal void Add(int from, int to, double times)
        {
            Span<double> ways = stackalloc double[Unknowns];
            for (int row = from; row < to; row++)
            {
                double came = Row(row, ways) * times;
                for (int i = 0; i < Unknowns; i++)
                {
                    products[i] += ways[i] * came;
                    for (int j = 0; j <= i; j++)
                    {
                        moments[i, j] += ways[i] * ways[j] * times;
                    }
                }
            }
        }

        /// <summary>By eigenvalues, since the taps of a coarsely recorded motion are linearly dependent.</summary>
        internal Vector<double> Solve()
        {
            Matrix<double> symmetric = moments.Clone();
            for (int i = 0; i < Unknowns; i++)
            {
                for (int j = 0; j < i; j++)
                {
                    symmetric[j, i] = symmetric[i, j];
                }
            }

            Evd<double> parts = symmetric.Evd(Symmetricity.Symmetric);
            Vector<double> turned = parts.EigenVectors.TransposeThisAndMultiply(products);
            double least = LeastOfLargest * parts.D[Unknowns - 1, Unknowns - 1];
            for (int i = 0; i < Unknowns; i++)
            {
                double eigenvalue = parts.D[i, i];
                turned[i] = eigenvalue > least ? turned[i] / eigenvalue : 0;
            }

            return parts.EigenVectors * turned;
        }

        internal double SquaredError(Vector<double> taps, int from, int to)
        {
            Span<double> ways = stackalloc double[Unknowns];
            double sum = 0;
            for (int row = from; row < to; row++)
            {
                double error = -Row(row, ways);
                for (int i = 0; i < Unknowns; i++)
                {
                    error += taps[i] * ways[i];
                }

                sum += error * error;
            }

            return sum;
        }

        private double Row(int row, Span<double> ways)
        {
            int newest = row + Taps - 1;
            for (int i = 0; i < Unknowns; i++)
            {
                ways[i] = line[newest - 1 - i] - line[newest];
            }

            return line[newest + steps] - line[newest];
        }
    }
}
