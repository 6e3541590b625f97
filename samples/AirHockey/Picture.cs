using System;
using System.Collections.Generic;
using System.Text;
using LagSim;
using LagSim.Hosting;
using LagSim.Net.Display;
using LagSim.Scenes;
using LagSim.Time;

namespace AirHockey;

/// <summary>The table as a picture of 80 by 24 characters: dots of Braille, two by four to a character, and text over them.</summary>
public sealed class Picture
{
    public const int Columns = 80;
    public const int Rows = 24;

    private const int FirstRow = 1; // of the table
    private const int TableRows = 21;
    private const double DotsPerMetre = 62;
    private const int Faint = 240, White = 15, Gold = 220;

    // Which bit of a Braille character is which dot.
    private static readonly int[,] Bits = { { 0x01, 0x08 }, { 0x02, 0x10 }, { 0x04, 0x20 }, { 0x40, 0x80 } };
    private static readonly int[] Sides = [39, 203]; // blue and red
    private static readonly string[] Names = ["LEFT", "RIGHT"];

    private static readonly Dictionary<char, string[]> Digits = new()
    {
        ['1'] = [" # ", "## ", " # ", " # ", "###"],
        ['2'] = ["## ", "  #", " # ", "#  ", "###"],
        ['3'] = ["## ", "  #", " # ", "  #", "## "],
    };

    private readonly int[,] dots = new int[Rows, Columns];
    private readonly char[,] text = new char[Rows, Columns];
    private readonly int[,] colours = new int[Rows, Columns];
    private readonly bool[,] isInverse = new bool[Rows, Columns];

    private static int Width => Columns * 2;

    private static int Height => TableRows * 4;

    /// <summary>Draws what a frame shows.</summary>
    /// <param name="snapshot">The world.</param>
    /// <param name="now">The time that is shown.</param>
    /// <param name="match">The state of the rules at that time.</param>
    /// <param name="elapsed">Seconds since the world began.</param>
    /// <param name="banner">A word in the middle; null for none.</param>
    /// <param name="status">The lowest line.</param>
    /// <param name="drawn">Where bodies are drawn, smoothly and in one's own hand; null for where they are.</param>
    public void Draw(
        RenderSnapshot snapshot, SimTime now, in Match match, double elapsed, string? banner, string status, DisplayOffsets? drawn = null)
    {
        Clear();
        DrawTable(match);
        for (int n = 0; n < snapshot.BodyCount; n++)
        {
            BodyId body = snapshot.BodyAt(n);
            if (snapshot.TryRead(body, now, out BodyState state))
            {
                Vector3D place = drawn is not null && drawn.TryRead(body, out DrawnBody seen) ? seen.Position : state.Position;
                DrawBody(body, snapshot.TagOf(body), state, place);
            }
        }

        double left = Math.Max(0, (double)match.Ends / SimDuration.TicksPerSecond - elapsed);
        string clock = match.Phase switch
        {
            Phase.CountDown => "get ready",
            Phase.Over => "over",
            _ => left > 0 ? $"{(int)Math.Ceiling(left) / 60}:{(int)Math.Ceiling(left) % 60:00}" : "next goal wins",
        };
        Write(0, 2, Names[0], Sides[0]);
        Write(0, Columns - 2 - Names[1].Length, Names[1], Sides[1]);
        Write(0, (Columns / 2) - 6, $"{match.Left,4}  :  {match.Right,-4}", White);
        Write(0, (Columns / 4) + 2 - (clock.Length / 2), clock, Faint + 8);
        if (match.Phase == Phase.CountDown && Digits.TryGetValue((char)('0' + match.Count), out string[]? digit))
        {
            DrawDigit(digit);
        }

        if (banner is not null)
        {
            Write(FirstRow + (TableRows / 2) - 3, (Columns - banner.Length - 4) / 2, $"  {banner}  ", Gold, inverse: true);
        }

        string chat = Encoding.UTF8.GetString(((ReadOnlySpan<byte>)match.Chat).TrimEnd((byte)0));
        if (match.Chats > 0)
        {
            Write(Rows - 2, 2, $"player {match.ChatFrom}: {chat}", Sides[Table.SideOf(match.ChatFrom)]);
        }

        Write(Rows - 1, 2, status, Faint + 6);
    }

    /// <summary>The picture as lines, with colours for a terminal or without.</summary>
    public string ToText(bool withColours)
    {
        StringBuilder lines = new();
        for (int row = 0; row < Rows; row++)
        {
            int colour = -1;
            bool inverse = false;
            for (int column = 0; column < Columns; column++)
            {
                char shown = text[row, column] != 0 ? text[row, column] : dots[row, column] != 0 ? (char)(0x2800 + dots[row, column]) : ' ';
                if (withColours && (colours[row, column] != colour || isInverse[row, column] != inverse))
                {
                    (colour, inverse) = (colours[row, column], isInverse[row, column]);
                    lines.Append(inverse ? "\x1b[7m" : "\x1b[27m").Append("\x1b[38;5;").Append(colour).Append('m');
                }

                lines.Append(shown);
            }

            lines.Append(withColours ? "\x1b[0m" : "").Append(row + 1 < Rows ? "\n" : "");
        }

        return lines.ToString();
    }

    private void Clear()
    {
        Array.Clear(dots);
        Array.Clear(text);
        Array.Clear(isInverse);
        for (int row = 0; row < Rows; row++)
        {
            for (int column = 0; column < Columns; column++)
            {
                colours[row, column] = Faint;
            }
        }
    }

    private void DrawTable(in Match match)
    {
        const double Step = 0.3 / DotsPerMetre;
        const double Straight = Table.HalfWidth - Table.CornerRadius;
        for (double z = -Table.HalfWidth; z <= Table.HalfWidth; z += 0.05)
        {
            Dot(0, z, Faint);
        }

        for (double angle = 0; angle < 2 * Math.PI; angle += 0.15)
        {
            Dot(0.2 * Math.Cos(angle), 0.2 * Math.Sin(angle), Faint);
        }

        foreach (int x in (int[])[-1, 1])
        {
            int side = x < 0 ? 0 : 1;
            for (double t = 0; t <= Table.HalfLength - Table.CornerRadius; t += Step)
            {
                Dot(x * t, -Table.HalfWidth, Faint + 10);
                Dot(x * t, Table.HalfWidth, Faint + 10);
            }

            for (double angle = 0; angle <= Math.PI / 2; angle += Step / Table.CornerRadius)
            {
                double cornerX = x * (Table.HalfLength - Table.CornerRadius + (Table.CornerRadius * Math.Cos(angle)));
                double cornerZ = Straight + (Table.CornerRadius * Math.Sin(angle));
                Dot(cornerX, cornerZ, Faint + 10);
                Dot(cornerX, -cornerZ, Faint + 10);
            }

            for (double z = Table.HalfMouth; z <= Straight; z += Step)
            {
                Dot(x * Table.HalfLength, z, Faint + 10);
                Dot(x * Table.HalfLength, -z, Faint + 10);
            }

            // The goal behind the line, and the shield before it.
            for (double z = -Table.HalfMouth; z <= Table.HalfMouth; z += Step)
            {
                Dot(x * (Table.HalfLength + 0.06), z, Sides[side]);
                if (match.Shielded == 1 + side)
                {
                    Dot(x * Table.HalfLength, z, Gold);
                    Dot(x * (Table.HalfLength - (1.2 / DotsPerMetre)), z, Gold);
                }
            }

            Disc(x * Table.HalfLength, Table.HalfMouth, Table.PostRadius, 0, Sides[side]);
            Disc(x * Table.HalfLength, -Table.HalfMouth, Table.PostRadius, 0, Sides[side]);
        }
    }

    private void DrawBody(BodyId body, ulong tag, in BodyState state, Vector3D place)
    {
        (double x, double z) = (place.X, place.Z);
        if (tag == Table.MalletTag)
        {
            int player = Table.PlayerOf(body);
            bool isBeyond = state.Filter == Table.MalletBeyond;
            Disc(x, z, Table.MalletRadius, isBeyond ? 0.8 * Table.MalletRadius : 0.6 * Table.MalletRadius, Sides[Table.SideOf(player)]);
            Put(x, z, (char)('0' + player), White);
        }
        else if (tag == Table.PuckTag)
        {
            Disc(x, z, Table.PuckRadius, 0, White);
        }
        else
        {
            Disc(x, z, Table.PuckRadius, 0.8 * Table.PuckRadius, Gold);
            Put(x, z, Symbol((PrizeKind)(tag - Table.PrizeTag)), Gold);
        }
    }

    /// <summary>How a prize is shown: 2 for a second puck, » for a fast one, # for a shield.</summary>
    public static char Symbol(PrizeKind kind) => "2»#"[(int)kind];

    private void DrawDigit(string[] digit)
    {
        const int Size = 5;
        for (int row = 0; row < digit.Length * Size; row++)
        {
            for (int column = 0; column < digit[0].Length * Size; column++)
            {
                if (digit[row / Size][column / Size] == '#')
                {
                    DotAt((Width / 2) + column - (digit[0].Length * Size / 2), (Height / 2) + row - (digit.Length * Size / 2), Gold);
                }
            }
        }
    }

    private void Disc(double x, double z, double radius, double hole, int colour)
    {
        (double column, double row) = Place(x, z);
        (double most, double least) = (radius * DotsPerMetre, hole * DotsPerMetre);
        for (int dy = (int)Math.Floor(row - most); dy <= row + most; dy++)
        {
            for (int dx = (int)Math.Floor(column - most); dx <= column + most; dx++)
            {
                double from = Math.Sqrt(((dx - column) * (dx - column)) + ((dy - row) * (dy - row)));
                if (from <= most && from >= least)
                {
                    DotAt(dx, dy, colour);
                }
            }
        }
    }

    private void Dot(double x, double z, int colour)
    {
        (double column, double row) = Place(x, z);
        DotAt((int)Math.Round(column), (int)Math.Round(row), colour);
    }

    private static (double Column, double Row) Place(double x, double z) =>
        ((Width / 2) - 0.5 + (x * DotsPerMetre), (Height / 2) - 0.5 + (z * DotsPerMetre));

    private void DotAt(int column, int row, int colour)
    {
        if (column >= 0 && row >= 0 && column < Width && row < Height)
        {
            dots[FirstRow + (row / 4), column / 2] |= Bits[row % 4, column % 2];
            colours[FirstRow + (row / 4), column / 2] = colour;
        }
    }

    private void Put(double x, double z, char shown, int colour)
    {
        (double column, double row) = Place(x, z);
        Write(FirstRow + ((int)Math.Round(row) / 4), (int)Math.Round(column) / 2, shown.ToString(), colour);
    }

    private void Write(int row, int column, string line, int colour, bool inverse = false)
    {
        for (int n = 0; n < line.Length; n++)
        {
            if (row >= 0 && row < Rows && column + n >= 0 && column + n < Columns && !char.IsControl(line[n]))
            {
                text[row, column + n] = line[n];
                colours[row, column + n] = colour;
                isInverse[row, column + n] = inverse;
            }
        }
    }
}
