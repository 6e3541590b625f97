using System;
using LagSim.Scenes;

namespace LagSim.Net.Display;

/// <summary>
/// Predicts a hand's mean velocity over the horizon as a weighted sum of its recent velocities, learned by least squares with forgetting.
/// </summary>
/// <remarks>
/// The normal equations themselves are kept and decay, and are solved again for each sample, with a ridge term that draws the weights to
/// zero. So nothing winds up while the hand rests, as in recursive least squares: the data fades, and the prediction becomes that the hand
/// stays. All axes share the weights, so the prediction is independent of direction.
/// </remarks>
internal sealed class OnlineLeastSquares
{
    /// <summary>The number of input velocities.</summary>
    internal const int Inputs = 5;

    private const double Prior = 0.002; // m^2/s^2: do not learn from the trembling of a hand

    private readonly double[] moments = new double[Inputs * Inputs];
    private readonly double[] products = new double[Inputs];
    private readonly double[] weights = new double[Inputs];
    private readonly double[] factor = new double[Inputs * Inputs];

    internal void Clear()
    {
        Array.Clear(moments, 0, moments.Length);
        Array.Clear(products, 0, products.Length);
        Array.Clear(weights, 0, weights.Length);
    }

    /// <summary>Lets the accumulated data fade to this fraction.</summary>
    internal void Fade(double kept)
    {
        for (int i = 0; i < moments.Length; i++)
        {
            moments[i] *= kept;
        }

        for (int i = 0; i < Inputs; i++)
        {
            products[i] *= kept;
        }
    }

    /// <summary>Learns that these velocities were followed by that mean velocity.</summary>
    internal void Learn(Vector3D[] inputs, in Vector3D came)
    {
        for (int i = 0; i < Inputs; i++)
        {
            for (int j = 0; j <= i; j++)
            {
                moments[(i * Inputs) + j] += Vector3D.Dot(inputs[i], inputs[j]);
            }

            products[i] += Vector3D.Dot(inputs[i], came);
        }

        Solve();
    }

    /// <summary>Predicts the mean velocity that follows these velocities.</summary>
    internal Vector3D Predict(Vector3D[] inputs)
    {
        Vector3D sum = default;
        for (int i = 0; i < Inputs; i++)
        {
            sum += inputs[i] * weights[i];
        }

        return sum;
    }

    /// <summary>Solves by Cholesky: with the prior on the diagonal the moments are positive definite.</summary>
    private void Solve()
    {
        for (int i = 0; i < Inputs; i++)
        {
            for (int j = 0; j <= i; j++)
            {
                double sum = moments[(i * Inputs) + j] + (i == j ? Prior : 0);
                for (int k = 0; k < j; k++)
                {
                    sum -= factor[(i * Inputs) + k] * factor[(j * Inputs) + k];
                }

                // Rounding can leave less than the prior when two inputs are equal.
                factor[(i * Inputs) + j] = i == j ? Math.Sqrt(Math.Max(sum, 0.5 * Prior)) : sum / factor[(j * Inputs) + j];
            }
        }

        for (int i = 0; i < Inputs; i++)
        {
            double sum = products[i];
            for (int k = 0; k < i; k++)
            {
                sum -= factor[(i * Inputs) + k] * weights[k];
            }

            weights[i] = sum / factor[(i * Inputs) + i];
        }

        for (int i = Inputs - 1; i >= 0; i--)
        {
            double sum = weights[i];
            for (int k = i + 1; k < Inputs; k++)
            {
                sum -= factor[(k * Inputs) + i] * weights[k];
            }

            weights[i] = sum / factor[(i * Inputs) + i];
        }
    }
}
