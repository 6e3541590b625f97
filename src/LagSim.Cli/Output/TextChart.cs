using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Text;

namespace LagSim.Cli.Output;

/// <summary>Curves in a terminal, in Braille patterns of two by four dots a character. Details are in the SVG.</summary>
internal static class TextChart
{
    private const int DotsAcross = 2;
    private const int DotsDown = 4;
    private const int LabelWidth = 10;

    /// <summary>Returns the bit of a Braille pattern for the dot in a column (left, right) and a row (from the top).</summary>
    private static readonly int[,] Dot = { { 0x01, 0x02, 0x04, 0x40 }, { 0x08, 0x10, 0x20, 0x80 } };

    /// <summary>Draws curves over one another; NaN leaves a gap.</summary>
    /// <param name="x">The x values, ascending.</param>
    /// <param name="curves">The curves, each as long as <paramref name="x"/>.</param>
    /// <param name="columns">The width in characters, without the labels.</param>
    /// <param name="rows">The height in characters.</param>
    /// <param name="label">Returns the label of a value on the y axis.</param>
    internal static string Draw(double[] x, IReadOnlyList<double[]> curves, int columns, int rows, Func<double, string> label)
    {
        double[] values = curves.SelectMany(curve => curve).Where(double.IsFinite).ToArray();
        if (x.Length == 0 || values.Length == 0)
        {
            return "";
        }

        double least = values.Min();
        double span = Math.Max(values.Max() - least, 1e-300);
        int[,] cells = new int[rows, columns];
        foreach (double[] curve in curves)
        {
            for (int i = 0; i < x.Length; i++)
            {
                if (double.IsFinite(curve[i]))
                {
                    int across = (int)((x[i] - x[0]) / Math.Max(x[^1] - x[0], 1e-300) * ((columns * DotsAcross) - 1));
                    int down = (int)Math.Round((1 - ((curve[i] - least) / span)) * ((rows * DotsDown) - 1));
                    cells[down / DotsDown, across / DotsAcross] |= Dot[across % DotsAcross, down % DotsDown];
                }
            }
        }

        StringBuilder text = new();
        for (int row = 0; row < rows; row++)
        {
            string edge = row == 0 ? label(least + span) : row == rows - 1 ? label(least) : "";
            text.Append(edge.PadLeft(LabelWidth)).Append(" │");
            for (int column = 0; column < columns; column++)
            {
                text.Append((char)(0x2800 + cells[row, column]));
            }

            text.AppendLine();
        }

        string left = x[0].ToString("0.0", CultureInfo.InvariantCulture);
        string right = x[^1].ToString("0.0 s", CultureInfo.InvariantCulture);
        text.Append(' ', LabelWidth).Append(" └").Append('─', columns).AppendLine();
        text.Append(' ', LabelWidth + 2).Append(left).Append(right.PadLeft(columns - left.Length)).AppendLine();
        return text.ToString();
    }
}
