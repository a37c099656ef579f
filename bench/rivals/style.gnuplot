# What both figures share. For gnuplot 5.4 and later.
set encoding utf8
set terminal pngcairo size 900, 560 font 'DejaVu Sans,12' background '#ffffff'
set datafile separator ','
set datafile columnheaders
set border 3 linecolor '#404040'
set tics out nomirror
set key outside right top vertical Left reverse noenhanced samplen 2.5 spacing 1.25
# Okabe & Ito 2008.
array colors[5] = [0xcc79a7, 0xd55e00, 0x0072b2, 0x009e73, 0x000000]
